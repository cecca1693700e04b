"""Writes a section of the report's page for a program of the tests: a paragraph and a folded table."""
import pathlib
import sys

TEMPLATES = pathlib.Path(__file__).resolve().parent.parent.parent / "reports/templates"


def write(name, title, words, summary, table, after=(), figure=()):
    """Writes reports/templates/NAME.mustache; with --check it writes nothing.

    figure, table and after are the lines above the paragraph, of the table and below it.
    Returns the exit status: 1 if --check finds a different section.
    """
    text = "\n".join([
        "{{#%s}}<section id=\"%s\">" % (name, name), f"  <h2>{title}</h2>", *figure, f"  <p>{words}</p>", "  <details>",
        f"  <summary>{summary}</summary>",
        f'  <div class="scroll" role="region" aria-label="{summary}" tabindex="0">',
        '  <table class="results-table">', *table, "  </table>", "  </div>", *after, "  </details>",
        "</section>{{/%s}}" % name, ""])
    page = TEMPLATES / f"{name}.mustache"
    if "--check" in sys.argv[1:]:
        return page.read_text() != text
    page.write_text(text)
    return 0
