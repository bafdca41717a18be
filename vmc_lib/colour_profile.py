"""Colour management: a picture's embedded ICC profile is honoured, as browsers do."""

from io import BytesIO

from PIL import ImageCms

MODES = ("RGB", "RGBA", "L", "CMYK")


def to_srgb(image):
    """A Pillow image in sRGB; as it is without a profile, or with one that cannot be read."""
    profile = image.info.get("icc_profile")
    if not profile or image.mode not in MODES:
        return image
    mode = "RGBA" if image.mode == "RGBA" else "RGB"
    try:
        source = ImageCms.ImageCmsProfile(BytesIO(profile))
        target = ImageCms.createProfile("sRGB")
        return ImageCms.profileToProfile(image, source, target, outputMode=mode)
    except (ImageCms.PyCMSError, OSError):  # damaged, or of another kind of picture
        return image
