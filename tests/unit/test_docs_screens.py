"""The screens in the documentation are what the program shows."""

import pytest
from consoles import blurred
from docscreens import PAGES, blocks, home, made


@pytest.mark.parametrize("page", PAGES)
def test_every_screen_is_what_the_program_shows(tmp_path, page):
    folder, found = home(tmp_path), list(blocks(page))
    assert found
    for block in found:
        shown = made(block, folder)
        said = "python tests/helpers/docscreens.py writes it again"
        assert blurred(shown) == blurred(block[3]), said
