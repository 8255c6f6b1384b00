"""Names become symbols in the packages of one image."""

from __future__ import annotations

import pytest

from eslang.base.image import PACKAGE, Image
from eslang.base.packages import Package
from eslang.base.resolve import NotExternal, UnknownPackage, resolve_in
from eslang.base.symbols import Keyword, Symbol


@pytest.fixture
def image() -> Image:
    made = Image()
    made.cell(PACKAGE).value = made.packages["ESL-USER"]
    return made


def test_a_bare_name_is_the_current_packages(image):
    resolve = resolve_in(image)
    assert resolve(None, "FOO", False) is Symbol.intern("FOO", "ESL-USER")
    assert resolve(None, "ASSERT", False) is Symbol.intern("ASSERT", "ESL")
    assert resolve(None, "NIL", False) is None
    image.cell(PACKAGE).value = image.packages["CL-USER"]
    assert resolve(None, "FOO", False) is Symbol.intern("FOO", "CL-USER")


def test_keywords_and_nicknames(image):
    resolve = resolve_in(image)
    assert resolve("KEYWORD", "FOO", True) is Keyword("foo")
    assert resolve("CL", "T", True) is Symbol.intern("T", "COMMON-LISP")


def test_only_external_symbols_are_had_with_one_colon(image):
    image.add_package(Package("RIG")).export("ARM")
    resolve = resolve_in(image)
    assert resolve("RIG", "ARM", True) is resolve("RIG", "ARM", False)
    assert resolve("RIG", "LEG", False) is Symbol.intern("LEG", "RIG")
    with pytest.raises(NotExternal) as caught:
        resolve("RIG", "LEG", True)
    assert (caught.value.present, caught.value.external) == (True, ("ARM",))
    with pytest.raises(NotExternal) as caught:
        resolve("RIG", "TOE", True)
    assert not caught.value.present


def test_an_unknown_package_tells_which_there_are(image):
    with pytest.raises(UnknownPackage) as caught:
        resolve_in(image)("RIGG", "ARM", True)
    assert "ESL-USER" in caught.value.known
