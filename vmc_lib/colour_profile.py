"""Colour management: a picture's embedded ICC profile is honoured, as browsers do."""

from io import BytesIO

from PIL import Image, ImageCms

MODES = ("RGB", "RGBA", "L", "CMYK")


def to_srgb(image: Image.Image) -> Image.Image:
    """A Pillow image as RGB, or RGBA, in sRGB: as it is where no profile can be read."""
    profile, mode = image.info.get("icc_profile"), "RGBA" if image.has_transparency_data else "RGB"
    if profile and image.mode in MODES:
        try:
            source = ImageCms.ImageCmsProfile(BytesIO(profile))
            target = ImageCms.createProfile("sRGB")
            return ImageCms.profileToProfile(image, source, target, outputMode=mode)
        except (ImageCms.PyCMSError, OSError):  # damaged, or of another kind of picture
            pass
    return image.convert(mode)
