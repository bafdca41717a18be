"""A photo's embedded colour profile: Python and the page see the same picture."""

import pytest
from PIL import Image, ImageCms

from vmc_lib import photos


def swapped_profile():
    """An ICC profile in which red and green have changed places."""
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    return profile.replace(b"rXYZ", b"?").replace(b"gXYZ", b"rXYZ").replace(b"?", b"gXYZ")


COLOUR = (220, 60, 40)
PROFILED = {
    "photo.jpg": {"quality": 95, "subsampling": 0},
    "photo.png": {},
    "transparent.png": {},
    "photo.webp": {"lossless": True},
}


def save_profiled(folder, name, profile):
    mode, opaque = ("RGBA", (255,)) if name.startswith("transparent") else ("RGB", ())
    picture = Image.new(mode, (600, 400), COLOUR + opaque)
    picture.save(folder / name, icc_profile=profile, **PROFILED[name])
    return folder / name


@pytest.mark.parametrize("name", PROFILED)
def test_an_embedded_colour_profile_is_honoured(name, tmp_path):
    image = photos.read_image(save_profiled(tmp_path, name, swapped_profile()))
    assert image[0, 0].tolist() == pytest.approx([60, 220, 40], abs=3)
    image = photos.read_image(save_profiled(tmp_path, name, b"damaged"))
    assert image[0, 0].tolist() == pytest.approx(COLOUR, abs=3)


@pytest.mark.browser
@pytest.mark.parametrize("name", PROFILED)
def test_the_page_sees_the_colours_that_python_sees(name, open_page, tmp_path):
    path = save_profiled(tmp_path, name, swapped_profile())
    page = open_page("<h1>P</h1><input type='file'>")
    page.set_input_files("input", path)
    seen = page.evaluate("""async () => {
      const picture = await createImageBitmap(document.querySelector("input").files[0]);
      const canvas = document.createElement("canvas");
      const context = vmc["canvas"].drawScaled(picture, 0.1, canvas);
      return [...context.getImageData(9, 9, 1, 1).data].slice(0, 3);
    }""")
    assert seen == pytest.approx(photos.read_image(path)[9, 9].tolist(), abs=2)
