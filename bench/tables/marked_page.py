"""Text that a script keeps up to date within a page, between two marks: <!-- NAME: begin --> and <!-- NAME: end -->."""

from pathlib import Path


def add_option(parser):
    """The option `--into` of a script that makes such text."""
    parser.add_argument("--into", type=Path, help="the page whose text between the marks is replaced")


def put(text, name, page):
    """Writes the text between the marks of that name in a page, or prints it where `page` is None. Ends the program in one line where the marks are not there once."""
    if page is None:
        print(text)
        return
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    whole = page.read_text()
    if whole.count(begin) != 1 or whole.count(end) != 1:
        raise SystemExit(f"{page}: needs the marks {begin} and {end} once")
    before, rest = whole.split(begin)
    page.write_text(f"{before}{begin}\n\n{text}\n{end}{rest.split(end)[1]}")
