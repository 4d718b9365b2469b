"""What the C headers of the core declare: constants, structs, functions.

In:  csrc/include/ and csrc/, by the names that #include takes. Nothing is compiled: the lists of
     macros (E3D_EACH_...) are expanded here, and of conditions those of C without ++ hold.
Out: a list of declarations for each header, and the values of all constants.
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
TOKEN = re.compile(r'"(?:\\.|[^"])*"|\w[\w.]*|\.\.\.|\s+|.', re.S)
OPENING, CLOSING = "([{", ")]}"


@dataclass
class Variable:
    """What a name stands for: a member, a parameter, a function, an array or a type."""

    name: str
    type: str  # without const
    const: bool = False
    stars: str = ""  # of a pointer, as in "*const *"
    is_pointer: bool = False  # to an array or to a function: (*name)
    sizes: list = field(default_factory=list)  # of an array, as they are written
    parameters: list | None = None  # of a function


@dataclass
class Struct:
    """A struct or a union; without members its insides are nobody else's."""

    name: str
    members: list  # variables, and structs that are members without being types
    kind: str = "struct"
    is_typedef: bool = True
    sizes: list = field(default_factory=list)  # of a member that is an array of them


@dataclass
class Enum:
    name: str | None
    constants: list


@dataclass
class Typedef:
    of: Variable


@dataclass
class Header:
    """A file: its name as #include takes it, what it includes, what it declares."""

    name: str
    includes: list
    declarations: list = field(default_factory=list)


class Headers:
    """Headers that are read, each once, with all that they include.

    Attributes
    ----------
    read : dict of str to Header
        By their names, those that are included first.
    constants : dict of str to int
        Enumerators, and macros that are whole numbers.
    types : dict of str to Struct, Enum or Typedef
    functions : dict of str to Variable
    """

    def __init__(self, *names):
        self.read, self.constants, self.types, self.functions = {}, {}, {}, {}
        self._macros = {}
        for name in names:
            self.add(name)

    def add(self, name):
        """Read a header of csrc/include/ or csrc/, unless it was read."""
        path = next(p for p in (FOLDER / "include" / name, FOLDER / name) if p.is_file())
        lines = list(_lines(path))
        includes = re.findall(r'^\s*#\s*include\s+"(.+?)"', "\n".join(lines), re.M)
        for other in includes:
            if other not in self.read:
                self.add(other)
        self.read[name] = header = Header(name, includes)
        defined = [self._define(line) for line in lines if re.match(r"\s*#\s*define\b", line)]
        code = " ".join(line for line in lines if not line.lstrip().startswith("#"))
        for statement in _statements("".join(self._expand(TOKEN.findall(code)))):
            self._declare(statement, header)
        header.declarations += [Enum(None, [name]) for name in defined if self._note(name)]

    def value(self, expression):
        """The whole number that an expression of constants is."""
        plain = re.sub(r"\b(0[xX][0-9a-fA-F]+|\d+)[uUlL]+\b", r"\1", expression)
        return eval(plain.replace("/", "//"), {"__builtins__": {}}, self.constants)

    def rows(self, macro):
        """The rows X(...) of a list E3D_EACH_...(X), as their arguments; none if it isn't there."""
        _, body = self._macros.get(macro, (None, []))
        calls = "".join(body).split("X(")[1:]
        return [split(_inside("(" + call)[0]) for call in calls]

    def _define(self, line):
        """Keep a macro, and return its name."""
        found = re.match(r"\s*#\s*define\s+(\w+)(?:\(([^)]*)\))?(.*)", line)
        name, parameters, body = found.groups()
        self._macros[name] = (parameters and split(parameters), TOKEN.findall(body.strip()))
        return name

    def _note(self, name):
        """Keep the value of a macro; return whether it is a whole number."""
        parameters, body = self._macros[name]
        try:
            value = parameters or self.value("".join(body))
        except (NameError, SyntaxError, TypeError):
            return False
        if isinstance(value, int):
            self.constants[name] = value
        return isinstance(value, int)

    def _expand(self, tokens):
        """The tokens with all calls of macros in place; macros without parameters are constants."""
        out, waiting = [], tokens[::-1]
        while waiting:
            token = waiting.pop()
            parameters, body = self._macros.get(token, (None, None))
            if not parameters or "(" not in waiting[-2:]:
                out.append(token)
                continue
            values = dict(zip(parameters, split(_taken(waiting)), strict=False))
            text = re.sub(r"\s*##\s*", "", "".join(values.get(word, word) for word in body))
            waiting += TOKEN.findall(text)[::-1]
        return out

    def _declare(self, text, header):
        """Add what one statement of a header declares."""
        text = re.sub(r"^(?:extern|static|inline|\s)+\b", "", text).strip()
        if not text or text.startswith(("_Static_assert", '"C"')):
            return
        is_typedef = text.startswith("typedef ")
        text = text.removeprefix("typedef ").strip()
        found = re.match(r"(enum|struct|union)\b\s*(\w*)\s*(\{|\w*$)", text)
        if found and found[3] != "{":
            made = Struct(found[3] or found[2], [], found[1], is_typedef)
        elif found:
            made = self._body(found[1], found[2], text[found.end() - 1 :], is_typedef)
        else:
            (variable,) = self.variables(text)
            made = Typedef(variable) if is_typedef else variable
            if variable.parameters is not None and not is_typedef:
                self.functions[variable.name] = variable
        name = made.of.name if isinstance(made, Typedef) else made.name
        if name and not isinstance(made, Variable):
            self.types[name] = made
        header.declarations.append(made)

    def _body(self, kind, tag, text, is_typedef):
        """An enum, a struct or a union, of the text from its brace on."""
        inside, rest = _inside(text)
        name, sizes = re.match(r"\s*(\w*)((?:\s*\[.*?\])*)", rest).groups()
        name = name or tag
        if kind == "enum":
            return Enum(name, self._enumerators(inside))
        members = []
        for member in _statements(inside):
            found = re.match(r"(struct|union)\s*\{", member)
            if found:
                members.append(self._body(found[1], "", member[found.end() - 1 :], False))
            else:
                members += self.variables(member)
        return Struct(name, members, kind, is_typedef, _sizes(sizes))

    def _enumerators(self, text):
        names, value = [], -1
        for one in filter(None, split(text)):
            name, _, expression = (part.strip() for part in one.partition("="))
            value = self.value(expression) if expression else value + 1
            self.constants[name] = value
            names.append(name)
        return names

    def variables(self, text):
        """The variables of one declaration: int a, *b[3]."""
        # Alignment is for processors of 32 bits: it moves nothing where layouts are read.
        text = re.sub(r"^_Alignas\(\d+\) ", "", re.sub(r"\s+", " ", text.strip()))
        base = re.match(r"((?:const |unsigned |struct |_Atomic )*)(\w+)( const)?", text)
        words = f"{base[1]}{base[3] or ''}".split()
        kind = " ".join([*(w for w in words if w in ("unsigned", "struct")), base[2]])
        rest = split(text[base.end() :])
        return [self._variable(kind, "const" in words, one) for one in rest]

    def _variable(self, kind, const, text):
        stars = re.match(r"[* ]*(?:const[* ]+)*", text)
        made = Variable("", kind, const, stars[0].replace(" ", "").replace("const", "const "))
        text = text[stars.end() :]
        made.is_pointer = text.startswith("(")
        if made.is_pointer:
            inside, text = _inside(text)
            made.name = inside.strip(" *")
        else:
            made.name, text = re.match(r"\s*(\w*)(.*)", text).groups()
        made.sizes = _sizes(text)
        if text.lstrip().startswith("("):
            inside, _ = _inside(text.lstrip())
            listed = [] if inside.strip() == "void" else split(inside)
            made.parameters = [self.variables(one)[0] for one in listed]
        return made


def split(text):
    """The parts of a text between commas that are in no parentheses."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in OPENING) - (letter in CLOSING)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def _sizes(text):
    return [size.strip() for size in re.findall(r"\[(.*?)\]", text.partition("(")[0])]


def _inside(text):
    """What is in the parenthesis that a text begins with, and what comes behind it."""
    depth = 0
    for at, letter in enumerate(text):
        depth += (letter in OPENING) - (letter in CLOSING)
        if depth == 0:
            return text[1:at], text[at + 1 :]
    raise ValueError(f"a parenthesis is not closed: {text[:60]}")


def _taken(tokens):
    """Take a parenthesis from the end of reversed tokens; return what is in it."""
    depth, taken = 0, []
    while depth or "(" not in taken:
        taken.append(tokens.pop())
        depth += (taken[-1] in OPENING) - (taken[-1] in CLOSING)
    return "".join(taken).strip()[1:-1]


def _statements(text):
    """The statements of a text, each up to its semicolon or its body."""
    start, at = 0, 0
    while at < len(text):
        if text[at] == "{" and text[start:at].rstrip().endswith(")"):
            yield text[start:at].strip()
            at = start = len(text) - len(_inside(text[at:])[1])
        elif text[at] in OPENING:
            at = len(text) - len(_inside(text[at:])[1])
        elif text[at] == ";":
            yield text[start:at].strip()
            at = start = at + 1
        else:
            at += 1


def _lines(path):
    """The lines of a header that hold for C: not those of C++, nor of one machine alone.

    Without comments, and with those of the .inl files that it includes, which are lists of rows.
    """
    text = re.sub(r"/\*.*?\*/|//[^\n]*", " ", path.read_text("utf-8"), flags=re.S)
    holds = []
    for line in text.replace("\\\n", " ").splitlines():
        listed = re.match(r'\s*#\s*include "(.*\.inl)"', line)
        if listed:
            yield from _lines(FOLDER / listed[1])
            continue
        found = re.match(r"\s*#\s*(ifndef|ifdef|if|elif|else|endif)\b", line)
        if not found:
            if all(holds):
                yield line
        elif found[1] == "endif":
            holds.pop()
        elif found[1] in ("else", "elif"):
            holds[-1] = not holds[-1] and found[1] == "else"
        else:
            holds.append(found[1] == "ifndef")
