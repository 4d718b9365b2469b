"""What shells complete with the scripts that ``engine3d completion`` prints."""

import os
import re
import select
import shutil
import subprocess

import pytest

from engine3d.apps.cli import main
from engine3d.apps.cli.commands.completion import SCRIPTS, command_list
from engine3d.apps.cli.parser import make_parser


def script(shell, capsys):
    assert main(["completion", shell]) == 0
    return capsys.readouterr().out


def run(shell, code, folder):
    program = shutil.which(shell) or pytest.skip(f"needs {shell}")
    done = subprocess.run(
        [program, "-c", code], capture_output=True, text=True, cwd=folder, timeout=60
    )
    assert done.stderr == ""
    return done.stdout.split("\n")


def test_all_commands_and_options_are_listed():
    commands = {command.name: command for command in command_list(make_parser())}
    parsers = make_parser().commands
    assert commands.keys() - {""} == parsers.keys() and len(parsers) > 5
    for name, parser in parsers.items():
        found = {one for option in commands[name].options for one in option.names}
        assert found == {one for action in parser._actions for one in action.option_strings}


def test_bash_completes(tmp_path, capsys):
    code = script("bash", capsys)
    for words, expected in (
        (["ren"], ["render"]),
        (["--ver"], ["--version"]),
        (["--no-plugins", "ren"], ["render"]),
        (["render", "--turn"], ["--turntable"]),
        (["--no-plugins", "render", "--turn"], ["--turntable"]),
        (["run", "--mode", "n"], ["normal"]),
        (["run", "--threads", ""], []),
        (["completion", "z"], ["zsh"]),
    ):
        typed = " ".join(f"'{word}'" for word in ["engine3d", *words])
        call = f"COMP_WORDS=({typed}); COMP_CWORD={len(words)}; _engine3d"
        out = run("bash", f"{code}\n{call}\nprintf '%s\\n' \"${{COMPREPLY[@]}}\"", tmp_path)
        assert list(filter(None, out)) == expected


def test_bash_completes_names_of_files_as_they_must_be_typed(tmp_path, capsys):
    """It does so at a terminal alone, where what stands for engine3d prints its words."""
    pty = pytest.importorskip("pty")
    bash = shutil.which("bash") or pytest.skip("needs bash")
    for name in ("my file.obj", "a*b.obj", "it's.obj"):
        (tmp_path / name).touch()
    start = f"{script('bash', capsys)}\nengine3d() {{ printf '<%s>' \"$@\"; }}\nPS1=READY"
    (tmp_path / "start.sh").write_text(start)
    terminal, other_end = pty.openpty()
    command = [bash, "--noprofile", "--rcfile", "start.sh", "-i"]
    ends = dict.fromkeys(("stdin", "stdout", "stderr"), other_end)
    child = subprocess.Popen(command, cwd=tmp_path, start_new_session=True, **ends)
    for line, expected in (
        ("render my", "<render><my file.obj>"),
        ("render my\\ f", "<render><my file.obj>"),
        ("render -o 'my f", "<render><-o><my file.obj>"),
        ("run --wireframe a", "<run><--wireframe><a*b.obj>"),
        ("--no-plugins render it", "<--no-plugins><render><it's.obj>"),
    ):
        read_until(terminal, "READY")
        os.write(terminal, f"engine3d {line}\t\n".encode())
        read_until(terminal, expected)
    child.kill()  # a Ctrl+D before the next prompt would be lost
    child.wait()
    os.close(terminal)
    os.close(other_end)


def read_until(terminal, text):
    """Read what a terminal shows until there is a text."""
    shown = ""
    while text not in shown:
        assert select.select([terminal], [], [], 20)[0], shown
        shown += os.read(terminal, 1).decode("latin-1")


def test_fish_completes(tmp_path, capsys):
    (tmp_path / "model.obj").touch()
    code = script("fish", capsys)
    for line, expected in (
        ("ren", "render"),
        ("render --turn", "--turntable"),
        ("run --mode n", "normal"),
        ("render -o mo", "model.obj"),
        ("completion z", "zsh"),
    ):
        out = run("fish", f"{code}\ncomplete -C 'engine3d {line}'", tmp_path)
        assert [entry.split("\t")[0] for entry in out if entry] == [expected]


def test_zsh_takes_the_script(tmp_path, capsys):
    code = script("zsh", capsys)
    setup = "autoload -U compinit; compinit -u -D\n"
    out = run("zsh", f"{setup}{code}\nprint $_comps[engine3d]; whence -w _engine3d", tmp_path)
    assert out[:2] == ["_engine3d", "_engine3d: function"]


def test_every_shell_can_be_chosen():
    shell = next(a for a in make_parser().commands["completion"]._actions if a.dest == "shell")
    assert tuple(shell.choices) == tuple(SCRIPTS)


def quoted(line):
    return re.findall(r"'((?:[^']|'')*)'", line)


def test_powershell_lists_every_command_option_and_value(capsys):
    code = script("powershell", capsys)
    assert code.isascii()  # it passes through the code page of a console
    lines = [line.strip() for line in code.splitlines()]
    first, *commands = command_list(make_parser())
    names = [name for option in first.options for name in option.names]
    assert quoted(lines[lines.index("} else {") - 1]) == [one.name for one in commands] + names
    cases = {cells[0]: cells[1:] for cells in map(quoted, lines) if len(cells) > 0}
    for command in commands:
        names = [name for option in command.options for name in option.names]
        assert cases[command.name] == ["-", *names, *command.words]
        for option in command.options:
            for name in option.names:
                case = cases.get(f"{command.name} {name}")
                if option.value is None or option.optional:
                    assert case is None
                else:
                    assert case == list(option.value if isinstance(option.value, tuple) else ())


def test_powershell_script_is_balanced(capsys):
    code = re.sub(r"'(?:[^']|'')*'", "''", script("powershell", capsys))
    for opening, closing in ("{}", "()"):
        depth = 0
        for letter in code:
            depth += (letter == opening) - (letter == closing)
            assert depth >= 0
        assert depth == 0


def test_powershell_completes(tmp_path, capsys):
    (tmp_path / "model.obj").touch()
    code = script("powershell", capsys)
    for line, expected in (
        ("ren", "render"),
        ("--ver", "--version"),
        ("render --turn", "--turntable"),
        ("run --mode n", "normal"),
        ("completion z", "zsh"),
    ):
        call = f"(TabExpansion2 'engine3d {line}' {9 + len(line)}).CompletionMatches.CompletionText"
        assert list(filter(None, run("pwsh", f"{code}\n{call}", tmp_path))) == [expected]
