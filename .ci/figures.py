"""Figures of a source tree; see .ci/figures. Each row says what it counts, so that two trees can be compared."""
import pathlib
import re
import subprocess
import sys

LONGEST_FUNCTION = 60  # lines, from the line of its name to its closing brace
PLAIN_NUMBERS = {0.0, 1.0, 2.0, 0.5}
# A topic of middling size. A file counts when it must name the topic's type, or when it is the topic's own data.
SAMPLE_TOPIC = "Coverage"
TOPIC_ROOMS = ("idl/", "common/", "tools/", "tests/unit/bus/", "tests/unit/wire/", "tests/support/", "tests/data/",
               "docs/topics.md")
PRINTED_BY_A_PROGRAM = ("docs/topics.md", "tests/data/")


def sources(root):
    """Relative paths of the C++ files, generated ones excepted."""
    skipped = {"build", "out", ".git", ".cache"}
    paths = [p.relative_to(root) for s in ("cpp", "hpp") for p in root.rglob("*." + s)]
    return sorted(p for p in paths if p.parts[0] not in skipped)


def blank_and_comment_lines(text):
    """(empty lines, lines that hold nothing but a comment)."""
    empty = comments = 0
    in_block = False
    for line in text.splitlines():
        line = line.strip()
        if not line:
            empty += 1
        elif in_block or line.startswith(("//", "/*")):
            comments += 1
            in_block = "*/" not in line if in_block or line.startswith("/*") else False
    return empty, comments


def long_functions(root, files):
    """(lines, file, name) of each function that is too long."""
    listing = subprocess.run(
        ["ctags", "-f", "-", "--languages=C++", "--c++-kinds=f", "--fields=+ne", "--excmd=number", "-L", "-"],
        input="\n".join(map(str, files)), cwd=root, text=True, capture_output=True, check=True).stdout
    found = []
    for row in listing.splitlines():
        fields = row.split("\t")
        numbers = dict(f.split(":", 1) for f in fields[3:] if f.startswith(("line:", "end:")))
        if {"line", "end"} <= numbers.keys():
            length = int(numbers["end"]) - int(numbers["line"]) + 1
            if length > LONGEST_FUNCTION:
                found.append((length, fields[1], fields[0]))
    return sorted(found, reverse=True)


LITERAL = re.compile(r"(?<![\w.'])(?:0[xX][\da-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)[fFuUlL]*(?!\w)")
CONSTANT = re.compile(r"\bconstexpr\b|\bk[A-Z]\w*(?:\[[^\]]*\])?\s*[={]|\bstatic const\b|\benum\b")
SETTING = re.compile(r"^[\w:<>,\s*&]+\s\w+(?:\{[^{}]*\}|\s*=\s*[^;(]*)$")  # a member with its default; .field() names its range


def without_comments_and_strings(text):
    text = re.sub(r'R"\((?:.|\n)*?\)"', '""', text)
    return re.sub(r'//[^\n]*|/\*(?:.|\n)*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\d)\'(?:\\.|[^\'\\])\'|^\s*#[^\n]*',
                  lambda m: "\n" * m.group(0).count("\n"), text, flags=re.M)


def bare_numbers(path, text):
    """Literals in code, beside those that a constant or a setting names."""
    count = 0
    for statement in without_comments_and_strings(text).split(";"):
        words = " ".join(statement.split())
        declared = re.split(r"[{}] (?=[\w/])", words)[-1] if path.suffix == ".hpp" else words
        if CONSTANT.search(words) or ".field(" in words or (path.suffix == ".hpp" and SETTING.match(declared.strip())):
            continue
        for literal in LITERAL.findall(words):
            digits = literal.replace("'", "").rstrip("uUlLfF" if not literal[:2].lower() == "0x" else "uUlL")
            value = float(int(digits, 16)) if digits[:2].lower() == "0x" else float(digits)
            count += value not in PLAIN_NUMBERS
    return count


def topic_places(root):
    """Files that name the sample topic's type by hand, and files that a program prints for it."""
    name = re.compile(r"\b" + SAMPLE_TOPIC + r"(PubSubType)?\b|`" + SAMPLE_TOPIC.lower() + "`")
    by_hand, printed = [], []
    for path in sorted(root.rglob("*")):
        relative = path.relative_to(root).as_posix()
        in_codec = re.match(r"services/[^/]+/codec\.", relative)
        if not path.is_file() or not (relative.startswith(TOPIC_ROOMS) or in_codec):
            continue
        own_data = path.stem == SAMPLE_TOPIC.lower() and relative.startswith("tests/data/")
        if own_data or name.search(path.read_text(errors="ignore")):
            (printed if relative.startswith(PRINTED_BY_A_PROGRAM) else by_hand).append(relative)
    return by_hand, printed


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    if not (root / "CMakeLists.txt").is_file():
        sys.exit(f"figures: {root} is no source tree of Aisle")
    text_of = {p: (root / p).read_text() for p in sources(root)}
    code = {p: t for p, t in text_of.items() if p.parts[0] != "tests"}
    tests = {p: t for p, t in text_of.items() if p.parts[0] == "tests"}

    lines = sum(t.count("\n") for t in code.values())
    counted = [blank_and_comment_lines(t) for t in code.values()]
    empty, comments = sum(c[0] for c in counted), sum(c[1] for c in counted)
    test_lines = sum(t.count("\n") for t in tests.values())
    too_long = long_functions(root, code)
    planner = {p: bare_numbers(p, t) for p, t in code.items() if p.parts[:2] == ("services", "local-planner")}
    worst = sorted(((n, str(p)) for p, n in planner.items() if n), reverse=True)
    by_hand, printed = topic_places(root)

    print(f"lines of C++ outside tests                   {lines}")
    print(f"files of C++ outside tests                   {len(code)}")
    print(f"functions of more than {LONGEST_FUNCTION} lines              {len(too_long)}")
    for length, file, function in too_long:
        print(f"    {length} lines: {function} in {file}")
    print(f"empty or comment lines                       {100 * (empty + comments) / lines:.1f} %")
    print(f"comment lines alone                          {100 * comments / lines:.1f} %")
    print(f"test lines a line of code                    {test_lines / lines:.2f}")
    print(f"bare numbers in services/local-planner       {sum(planner.values())}"
          "  (literals but 0, 1, 2, 0.5, outside constants and defaults of settings)")
    for number, file in worst[:5]:
        print(f"    {number} in {file}")
    print(f"places the topic {SAMPLE_TOPIC} touches            {len(by_hand) + len(printed)}"
          f"  ({len(by_hand)} by hand, {len(printed)} printed by a program; its services' shells and cores not counted)")
    for file in by_hand + printed:
        print(f"    {file}")


main()
