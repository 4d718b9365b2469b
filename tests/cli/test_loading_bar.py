"""The bar shows on a terminal, after a while, and nowhere else."""

import io

import pytest

from engine3d.apps.cli import loading_bar


class Terminal(io.StringIO):
    def isatty(self):
        return True


def written(monkeypatch, stream, patience):
    monkeypatch.setattr(loading_bar, "_PATIENCE", patience)
    monkeypatch.setattr("sys.stderr", stream)
    monkeypatch.setenv("TERM", "xterm")
    with loading_bar.LoadingBar() as progress:
        for fraction in (0.0, 0.5, 1.0):
            progress(fraction)
    return stream.getvalue()


def test_a_terminal_sees_it(monkeypatch):
    assert "loading" in written(monkeypatch, Terminal(), 0)


@pytest.mark.parametrize(("stream", "patience"), [(io.StringIO, 0), (Terminal, 60)])
def test_neither_files_nor_short_work_see_it(monkeypatch, stream, patience):
    assert written(monkeypatch, stream(), patience) == ""


def test_it_is_gone_after_an_error(monkeypatch):
    monkeypatch.setattr(loading_bar, "_PATIENCE", 0)
    monkeypatch.setattr("sys.stderr", Terminal())
    with pytest.raises(ValueError, match="broken"), loading_bar.LoadingBar() as progress:
        progress(0.5)
        raise ValueError("broken")
    assert not progress._bar.live.is_started
