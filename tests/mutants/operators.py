"""Small breaks of C++ sources: what is listed here, and where it can be done.

A site is an expression or a statement, and what it is when broken. Comments,
texts, asserts (and is_consistent, which they alone call), what is logged, and
what the preprocessor and templates read are no sites.
"""
import dataclasses
import re


@dataclasses.dataclass(frozen=True)
class Site:
    """`text` at `start` of a source can become `broken`; which is a statement,
    a condition or another expression (`kind`)."""
    start: int
    text: str
    broken: str
    kind: str
    operator: str

    @property
    def end(self):
        return self.start + len(self.text)


def twice(found):
    """2.5 becomes 5.0, 10ms 20ms."""
    number, unit = re.fullmatch(r"([\d.']+)(\w*)", found[0]).groups()
    if "." in number:
        return f"{2 * float(number)}{unit}"
    return f"{2 * int(number.replace(chr(39), ''))}{unit}"


# Operator, weight in the draw, what is looked for, what it becomes. Limits that
# move by the least there is (<= for <) seldom matter to numbers like 0.137, so
# they are drawn seldom; by hand they are written where they matter.
TOKENS = [
    ("comparison negated", 1, r" < ", " >= "),
    ("comparison negated", 1, r" > ", " <= "),
    ("comparison negated", 1, r" <= ", " > "),
    ("comparison negated", 1, r" >= ", " < "),
    ("comparison negated", 1, r" == ", " != "),
    ("comparison negated", 1, r" != ", " == "),
    ("limit", .1, r" < ", " <= "),
    ("limit", .1, r" <= ", " < "),
    ("limit", .1, r" > ", " >= "),
    ("limit", .1, r" >= ", " > "),
    ("and, or", 1, r" && ", " || "),
    ("and, or", 1, r" \|\| ", " && "),
    ("arithmetic", 1, r" \+ ", " - "),
    ("arithmetic", 1, r" - ", " + "),
    ("arithmetic", 1, r" \* ", " / "),
    ("arithmetic", 1, r" / ", " * "),
    ("true, false", 1, r"\btrue\b", "false"),
    ("true, false", 1, r"\bfalse\b", "true"),
    ("0, 1", .3, r"(?<![\w.])0(?![\w.'])", "1"),
    ("0, 1", .3, r"(?<![\w.])1(?![\w.'])", "0"),
    ("constant doubled", 1,
     r"(?<![\w.])(?!0\.0\b)\d+\.\d+(?![\w.])", twice),
    ("constant doubled", .5,
     r"(?<![\w.'])(?![01]\b)\d[\d']*(?:ms|us|s)?(?![\w.'])", twice),
    ("least, most", 1, r"std::min\(", "std::max("),
    ("least, most", 1, r"std::max\(", "std::min("),
]
WEIGHTS = {name: weight for name, weight, _, _ in TOKENS} | {
    "condition negated": 1, "statement removed": 1, "arguments swapped": .5}

# What logs and prints only.
TELLS = re.compile(r"(?:\w+::)?(?:log|say|tell|f?print\w*|warn)\(")
# Functions for which the order of arguments is nothing.
SYMMETRIC = {"min", "max", "hypot", "swap", "distance_m", "dot", "equal"}
STATEMENT = re.compile(
    r"(?<=[;{}):])\s+("
    r"(?!return\b|throw\b|else\b|if\b|for\b|while\b|using\b|case\b|delete\b)"
    r"(?:[a-z_][\w.:]*(?:->\w+|\[\w+\]|\.\w+)*(?:\(| [-+*/|]?= )"
    r"|\+\+[a-z]|continue;|return;))")
OPENING, CLOSING = "([{", ")]}"


def code_of(source):
    """The source with blanks, of the same number, for all that is no code."""
    def blank(found):
        return re.sub(r"[^\n]", " ", found[0])

    text = re.sub(r'R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|//[^\n]*'
                  r"|(?<!\w)'(?:[^'\\\n]|\\.)+'|/\*.*?\*/",
                  blank, source, flags=re.S)
    for of in (r"^#(?:[^\n]*\\\n)*[^\n]*", r"^\s*using [^;]*;",
               r"^[ \t]*(?:static_)?assert\(.*?\); *$", r"^template <[^\n]*>$",
               r"^bool [\w:]*is_consistent\(\) const \{.*?^\}$",
               r"\bcase [^;{}]*?:(?!:)", r"\[\[\w+[^\]]*\]\]",
               r"\boperator[^\s\w(]+"):
        text = re.sub(of, blank, text, flags=re.M | re.S)
    return text


def closing(code, at):
    """Where the bracket that opens at `at` closes."""
    depth = 0
    for i in range(at, len(code)):
        depth += (code[i] in OPENING) - (code[i] in CLOSING)
        if depth == 0:
            return i
    return len(code)


def is_border(code, i, wide):
    """Whether an expression ends at i, outside of brackets."""
    c, two = code[i], code[i:i + 2]
    if c in ",;?":
        return True
    if c == ":":
        return "::" not in (two, code[i - 1:i + 1])
    if c == "=":
        return two != "==" and code[i - 1] not in "=<>!"
    if two in ("&&", "||") or code[i - 1:i + 1] in ("&&", "||"):
        return not wide
    return two == "<<" or code[i - 1:i + 1] == "<<"


def expression_around(code, start, end, wide):
    """Start and end of the expression that a token stands in; with `wide`, as
    wide as && and || reach."""
    depth, first = 0, start
    while first > 0:
        c = code[first - 1]
        depth += (c in CLOSING) - (c in OPENING)
        if depth < 0 or depth == 0 and is_border(code, first - 1, wide):
            break
        if depth == 0 and c == "{":
            break
        if depth == 0 and re.match(r"return\b", code[first - 1:first + 6]) \
                and not code[first - 2].isalnum():
            first += 5
            break
        first -= 1
    depth, last = 0, end
    while last < len(code):
        c = code[last]
        depth += (c in OPENING) - (c in CLOSING)
        if depth < 0 or depth == 0 and is_border(code, last, wide):
            break
        last += 1
    while code[first].isspace():
        first += 1
    while code[last - 1].isspace():
        last -= 1
    return first, last


def is_expression(text):
    """Not the head of a statement, nor the end of a template's arguments."""
    return not re.match(r"(?:for|if|else|while|do|switch|const|auto|static)\b"
                        r"|\d+>", text)


def broken_tokens(source, code):
    for name, _, old, new in TOKENS:
        for found in re.finditer(old, code):
            first, last = expression_around(
                code, found.start(), found.end() - found[0].endswith("("),
                name == "and, or")
            if not is_expression(code[first:last]):
                continue
            by = new(found) if callable(new) else new
            yield Site(first, source[first:last],
                       source[first:found.start()] + by
                       + source[found.end():last], "expression", name)


def negated_conditions(source, code):
    for found in re.finditer(r"\bif \((?=[\w!(*])", code):
        first = found.end()
        last = closing(code, first - 1)
        if ";" in code[first:last] or re.match(
                r"(?:const )?auto\b|const \w", code[first:last]):
            continue
        text = source[first:last]
        yield Site(first, text, f"!({text})", "condition", "condition negated")


def removed_statements(source, code):
    for found in re.finditer(STATEMENT, code):
        first = found.start(1)
        if TELLS.match(code, first):
            continue
        depth, last = 0, first
        while last < len(code) and not (code[last] == ";" and depth == 0):
            depth += (code[last] in OPENING) - (code[last] in CLOSING)
            if depth < 0:
                break
            last += 1
        if last >= len(code) or depth != 0 or not is_statement(code, first):
            continue
        yield Site(first, source[first:last + 1], "", "statement",
                   "statement removed")


def is_statement(code, at):
    """Whether what begins at `at` is the body of something, not a member's
    initialiser or the next part of a for."""
    before = code[:at].rstrip()
    if before[-1] == ":":
        return bool(re.search(r"(?:case .*|default) *:$", before))
    if before[-1] == ";":  # not within the brackets of a for
        return before.count("(", before.rfind("\n")) <= before.count(
            ")", before.rfind("\n"))
    return True


def swapped_arguments(source, code):
    simple = r"[a-z_][\w.]*(?:\(\))?"
    for found in re.finditer(rf"\b([a-z_]\w*)(\()({simple}), ({simple})\)",
                             code):
        if found[1] in SYMMETRIC or found[3] == found[4]:
            continue
        first, last = found.start(3), found.end(4)
        if found[1] in ("if", "for", "while", "return"):
            continue
        begin, end = expression_around(code, found.start(), found.end(), False)
        if not is_expression(code[begin:end]):
            continue
        yield Site(begin, source[begin:end], source[begin:first]
                   + f"{found[4]}, {found[3]}" + source[last:end],
                   "expression", "arguments swapped")


def sites(source):
    """All sites of a source, in its order."""
    code = code_of(source)
    found = [*broken_tokens(source, code), *negated_conditions(source, code),
             *removed_statements(source, code),
             *swapped_arguments(source, code)]
    return sorted(found, key=lambda x: (x.start, x.end, x.broken))
