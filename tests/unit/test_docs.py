"""The pages of docs/ hang together: links, navigation, commands, names of the Python API."""

import re
import sys

import click
import pytest
from pages import DOCS, PAGES, ROOT, anchors, code, links

import trunnion
from trunnion.cli import cli

sys.path.insert(0, str(DOCS / "_site"))
from navigation import parts

READ = [*PAGES, ROOT / "README.md"]


def named(path):
    return path.stem


@pytest.mark.parametrize("page", READ, ids=named)
def test_links_lead_somewhere(page):
    for line, target in links(page):
        if target.startswith(("http:", "https:", "mailto:")):
            continue
        path, _, anchor = target.partition("#")
        place = page.parent / path if path else page
        assert place.exists(), f"{page.name}:{line}: {target} is not there"
        if anchor:
            assert anchor in anchors(place), f"{page.name}:{line}: {target} has no such heading"


def test_every_page_is_in_the_navigation():
    front = parts((DOCS / "index.md").read_text(encoding="utf-8"))
    listed = [page for pages in front.values() for _, page in pages]
    assert len(listed) == len(set(listed))
    pages = {page.stem for page in PAGES} - {"index"}
    assert not pages - set(listed), "docs/index.md has no link to these pages"
    assert not set(listed) - pages, "docs/index.md has links to pages that are not there"
    assert next(iter(front)) == "Begin"
    assert front["Begin"][0][1] == "tutorial"


def test_readme_leads_to_the_front_page():
    assert "docs/index.md" in [target for _, target in links(ROOT / "README.md")]


PLACE = re.compile(r"(?:python|fortran|tests|models|benchmarks|docs)/[\w/.-]*\w\.\w+")


@pytest.mark.parametrize("page", READ, ids=named)
def test_files_named_are_there(page):
    """A path from the top, and the bare names that follow it in a line of paths alone."""
    for text in re.findall(r"`([^`\s]+)`", page.read_text(encoding="utf-8")):
        if PLACE.fullmatch(text):
            assert (ROOT / text).exists(), f"{page.name}: {text}"
    for line in page.read_text(encoding="utf-8").splitlines():
        if re.fullmatch(r"(`[\w/.]+\.(py|f90|c)`[,; ]*)+", line):
            folder = ROOT
            for name in re.findall(r"`([^`]+)`", line):
                if (ROOT / name).exists():
                    folder = (ROOT / name).parent
                near = (folder / name, ROOT / "python/trunnion" / name)
                assert any(path.exists() for path in (ROOT / name, *near)), f"{page.name}: {name}"


CALL = re.compile(r"(?:^|(?<!from)[\s(/$])trunnion ([a-z][\w-]*)(.*)")


@pytest.mark.parametrize("page", READ, ids=named)
def test_commands_and_options_exist(page):
    for text in code(page):
        for call in CALL.finditer(text):
            name, rest = call[1], re.split(r"[|;&>]", call[2])[0]
            command = cli.get_command(click.Context(cli), name)
            assert command is not None, f"{page.name}: trunnion {name}"
            known = {option for parameter in command.params for option in parameter.opts}
            for option in re.findall(r"(?<!\S)(--[a-z][\w-]*|-[a-z])\b", rest):
                assert option in known | {"--help", "-h"}, f"{page.name}: {text}"


@pytest.mark.parametrize("page", READ, ids=named)
def test_make_targets_exist(page):
    rules = re.findall(r"^([a-z][a-z -]*):", (ROOT / "Makefile").read_text(), flags=re.M)
    targets = {target for rule in rules for target in rule.split()}
    for text in code(page):
        for name in re.findall(r"^\s*make ([a-z][a-z-]*)", text):
            assert name in targets, f"{page.name}: make {name}"


def test_python_pages_name_everything_public():
    reference = (DOCS / "api_reference.md").read_text()
    overview = (DOCS / "api.md").read_text().split("## ")[0]
    for name in trunnion.__all__:
        assert f":: trunnion.{name}\n" in reference, f"api_reference.md leaves out {name}"
        assert re.search(rf"`(trunnion\.)?{name}\b", overview), f"api.md leaves out {name}"
    directives = re.findall(r"^\.\. auto\w+:: ([\w.]+)$", reference, flags=re.M)
    for name in directives:
        module, _, attribute = name.rpartition(".")
        assert hasattr(__import__(module, fromlist=[attribute]), attribute), name
