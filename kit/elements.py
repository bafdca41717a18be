"""XML elements, made from the inside out."""

from xml.etree import ElementTree


def element(tag, *children, text=None, **attributes):
    """An element with its children in it."""
    made = ElementTree.Element(tag, attributes)
    made.text = text
    made.extend(children)
    return made


def xml(root):
    """The bytes of a document, UTF-8."""
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True)
