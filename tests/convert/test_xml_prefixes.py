"""Prefixes that a file does not declare are declared, so that parsers with namespaces read it."""

from xml.etree import ElementTree

import pytest

from usd2kg.convert.xml_prefixes import declare_prefixes


@pytest.mark.parametrize(
    "text",
    [
        "<robot><drake:member/></robot>",
        "<?xml version='1.0'?>\n<!-- <robot> -->\n<robot name='a'><limit drake:acceleration='1'/></robot>",
        "<robot xmlns:xacro='x'><a:b/><xacro:c/><a:d a:e='1' f:g='2'/></robot>",
        '<?xml version="1.0" encoding="UTF-8"?><robot><Grüße:x/></robot>',
        "\ufeff<robot><a:b/></robot>",
    ],
)
def test_undeclared_prefixes(text: str):
    with pytest.raises(ElementTree.ParseError, match="unbound prefix"):
        ElementTree.fromstring(text.encode())
    declared = declare_prefixes(text.encode())
    assert declared is not None
    assert ElementTree.fromstring(declared).tag == "robot"
    assert declare_prefixes(declared) is None


@pytest.mark.parametrize(
    "data",
    [
        b"<robot/>",
        b"<robot xmlns:drake='x'><drake:member/></robot>",
        b"<robot xml:lang='en'/>",
        b"<robot><a:b>",
        b"nothing",
        b"<!DOCTYPE r [<!ENTITY x 'y'>]><r><a:b/></r>",
        "<robot><a:b/></robot>".encode("utf-16"),
        b"<?xml version='1.0' encoding='no-such'?><r><a:b/></r>",
    ],
)
def test_nothing_to_declare(data: bytes):
    assert declare_prefixes(data) is None
