"""Packages in SCORM 1.2, which Moodle imports: a page that tells the platform when it is done."""

from html import escape
from pathlib import Path
from zipfile import ZIP_DEFLATED

from book._ext.policy import seal
from vmc_lib.show.packed import pack_zip

SCRIPT = (Path(__file__).parent / "scorm.js").read_text(encoding="utf-8")
MANIFEST = """<?xml version="1.0" encoding="utf-8"?>
<manifest identifier="{name}" version="1.2" xmlns="http://www.imsproject.org/xsd/imscp_rootv1p1p2"
  xmlns:adlcp="http://www.adlnet.org/xsd/adlcp_rootv1p2">
  <metadata><schema>ADL SCORM</schema><schemaversion>1.2</schemaversion></metadata>
  <organizations default="course">
    <organization identifier="course">
      <title>{title}</title>
      <item identifier="item" identifierref="page"><title>{title}</title></item>
    </organization>
  </organizations>
  <resources>
    <resource identifier="page" type="webcontent" adlcp:scormtype="sco" href="index.html">
      <file href="index.html"/>
    </resource>
  </resources>
</manifest>
"""


def package(name, title, page):
    """The bytes of a zip that holds the HTML `page`; the same page gives the same bytes."""
    index = seal(page.replace("</html>", f"<script>\n{SCRIPT}</script>\n</html>"))
    manifest = MANIFEST.format(name=name, title=escape(title))
    return pack_zip({"imsmanifest.xml": manifest, "index.html": index}, ZIP_DEFLATED)
