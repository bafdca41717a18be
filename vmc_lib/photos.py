"""The photo set: 600 × 400 photos, each with the truth in a sidecar file.

The paper's own CASIA-RTA-VM set is private, so the photos of three levels are rendered (`render`);
their sidecars hold the exact boxes of the shuttlecock and the cup, the camera in the shoulder
frame, and the shuttlecock's true place. Those of the level "real" are photographs, boxed by hand.
"""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image, ImageOps, UnidentifiedImageError

from vmc_lib import data
from vmc_lib.boxes import as_boxes
from vmc_lib.camera import Camera
from vmc_lib.checks import check_count
from vmc_lib.colour_profile import to_srgb
from vmc_lib.compiled import compiled
from vmc_lib.short_repr import short

LEVELS = ("rig", "free", "varied")  # rendered, so that cameras and places are known
REAL_LEVEL = "real"  # photographs
SHEET_LEVEL = "sheet"  # rendered, with the printed sheet of `marker_sheet`: for tests alone
EVERY_LEVEL = (*LEVELS, REAL_LEVEL)
SPLITS = ("train", "validation", "test")
CLASSES = ("shuttlecock", "cup")
WIDTH, HEIGHT = 600, 400
FOLDER, EVERYDAY = data.FOLDER / "photos", data.FOLDER / "real"


@dataclass(frozen=True, eq=False)
class Photo:
    """A photo and the truth about it; what only a renderer knows is None in photographs.

    boxes: name of a thing → (4,), around its visible pixels; more: (n, 4), further things of the
    same kind; unclear: (n, 4), what may be a cup or not, and counts as neither; credit: whose it
    is, and its licence. From a renderer: target: (3,), m, the middle of the shuttlecock's axis
    (cork tip to centre of the skirt's rim) in the shoulder frame; turn: the trunk's turn (rad) for
    which the place was drawn; pose: "lying" or "standing"; seed: what remakes it.
    """

    name: str
    file: Path
    boxes: Mapping[str, np.ndarray]
    more: np.ndarray
    unclear: np.ndarray
    credit: str
    level: str = ""
    split: str = ""
    camera: Camera | None = None
    target: np.ndarray | None = None
    turn: float | None = None
    pose: str | None = None
    seed: tuple = ()

    def __repr__(self) -> str:
        return f"Photo({self.name!r}: {', '.join(self.boxes)})"

    def __getstate__(self) -> dict[str, Any]:
        """State to pickle or copy: boxes as a dict, for a read-only mapping cannot be pickled."""
        return vars(self) | {"boxes": dict(self.boxes)}

    @property
    def image(self) -> np.ndarray:
        """(400, 600, 3) uint8, read-only, read from the file at the first use."""
        return _image(self.file)


@lru_cache(64)  # a level can have hundreds
def _image(file):
    return data.read_only(read_image(file))


def load(level: str, split: str, folder: str | Path = FOLDER) -> list[Photo]:
    """Load the photos of one level and split.

    Parameters
    ----------
    level : one of EVERY_LEVEL, or SHEET_LEVEL
    split : one of SPLITS
    folder : path that holds the levels; by default of those that ship

    Returns
    -------
    list of Photo, in order of their names

    Raises
    ------
    ValueError, FileNotFoundError
        For an unknown level or split, an empty folder, and a damaged or a missing photo.

    Examples
    --------
    >>> load("rig", "train")[0].image.shape
    (400, 600, 3)
    """
    known = *EVERY_LEVEL, SHEET_LEVEL
    if level not in known:
        raise ValueError(f"unknown level {level!r}: choose from {known}")
    if split not in SPLITS:
        raise ValueError(f"unknown split {split!r}: choose from {SPLITS}")
    if not isinstance(folder, str | Path):
        raise ValueError(f"folder {short(folder)}: give the path of what holds the levels")
    place = Path(folder) / level / split
    sidecars = sorted(place.glob("*.json"))
    if not sidecars:
        raise ValueError(f"no photos under {place}: python -m reproduce.render makes them")
    return list(map(_read_sidecar, sidecars))


def load_levels(split: str, folder: str | Path = FOLDER, step: int = 1) -> list[Photo]:
    """Load the photos of a split of all LEVELS in turn; of each level every `step`-th."""
    check_count("step", step, least=1)
    return [photo for level in LEVELS for photo in load(level, split, folder)[::step]]


@cache
def everyday() -> tuple[Photo, ...]:
    """The real photos of everyday things, without shuttlecocks, in order of their names."""
    return tuple(map(_read_sidecar, sorted(EVERYDAY.glob("*.json"))))


@cache
def _read_sidecar(sidecar):
    """The `Photo` that a sidecar describes; everyday things stand in no level."""
    truth, file = json.loads(data.read(sidecar)), sidecar.with_suffix(".jpg")
    data.read(file)  # raises if the image is not the one that ships
    more, unclear = (data.read_only(as_boxes(truth.get(key, []))) for key in ("also", "ignore"))
    place = () if sidecar.parent == EVERYDAY else sidecar.parent.parts[-2:]
    rendered = {}
    if "camera" in truth:
        camera = {key: np.array(value)[()] for key, value in truth["camera"].items()}
        rendered = {"camera": Camera(**camera), "target": data.read_only(np.array(truth["target"]))}
        rendered |= {"turn": truth["turn"], "pose": truth["pose"], "seed": tuple(truth["seed"])}
    boxes = {name: data.read_only(np.array(box, float)) for name, box in truth["boxes"].items()}
    return Photo(
        "/".join((*place, sidecar.stem)),
        file,
        MappingProxyType(boxes),
        more,
        unclear,
        "; ".join(truth[key] for key in ("credit", "licence") if key in truth),
        *place,
        **rendered,
    )


def check_photos(shots: Any) -> None:
    """Raise ValueError where what should be a list of photos is none, or empty."""
    listed = isinstance(shots, Sequence) and len(shots)
    if not listed or not all(hasattr(one, "boxes") for one in shots):
        raise ValueError(f'{short(shots)} holds no photos: give a list, load("rig", "train")')


def boxes_of(photo: Photo, name: str) -> np.ndarray:
    """The boxes (n, 4) of every thing of that name; ValueError where `more` may be another's."""
    if not hasattr(photo, "boxes"):
        raise ValueError(f'photo {short(photo)} is no Photo: give one of load("rig", "train")')
    if len(photo.more) and len(photo.boxes) > 1:
        raise ValueError(f"{photo.name}: which of {', '.join(photo.boxes)} are the further things?")
    return as_boxes([photo.boxes[name], *photo.more] if name in photo.boxes else [])


def read_image(source: str | Path | np.ndarray) -> np.ndarray:
    """Read an image as (400, 600, 3) uint8 RGB, letterboxed on grey.

    Parameters
    ----------
    source : path, or array as `as_rgb` takes it

    Raises
    ------
    ValueError
        For a file that is missing, truncated or no image, and for other arrays.

    Examples
    --------
    >>> read_image(np.zeros((800, 800))).shape
    (400, 600, 3)
    """
    if not isinstance(source, str | Path | np.ndarray):
        raise ValueError(f"a {type(source).__name__} is no photo: give a path or an array")
    image = as_rgb(source) if isinstance(source, np.ndarray) else _open(source)
    return image if image.shape == (HEIGHT, WIDTH, 3) else _letterbox(image)


def as_rgb(array: ArrayLike) -> np.ndarray:
    """Convert an array (h, w), (h, w, 1), (h, w, 3) or (h, w, 4) to uint8 RGB (h, w, 3), a copy.

    Takes uint8, or floats within [0, 1], scaled to 0..255. Grey is repeated in three channels, what
    is transparent stands on white. ValueError for anything else.
    """
    if isinstance(array, str | Path):
        raise ValueError(f"{str(array)!r} is a file's name: give read_image({str(array)!r})")
    if isinstance(array, Photo):
        raise ValueError(f"{array.name!r} is a Photo, with more than an image: give photo.image")
    try:
        array = np.asarray(array)
    except ValueError:
        raise ValueError(f"{short(array)} is no image: give rows of a length, (h, w, 3)") from None
    image = array[..., None] if array.ndim == 2 else array
    if image.ndim != 3 or image.shape[2] not in (1, 3, 4) or 0 in image.shape:
        raise ValueError(f"an array of shape {array.shape} is not an image: give (h, w, 3)")
    if np.issubdtype(image.dtype, np.floating):
        if not (np.all(image >= 0) and np.all(image <= 1)):
            raise ValueError("a float image needs finite values in 0..1: divide 8 bits by 255")
        image = np.round(image * 255).astype(np.uint8)
    if image.dtype != np.uint8:
        raise ValueError(f"an image of {image.dtype} has no known range: give uint8")
    if image.shape[2] == 4:
        opaque = image[..., 3:] / np.float32(255)
        return (image[..., :3] * opaque + 255 * (1 - opaque) + 0.5).astype(np.uint8)
    return np.repeat(image, 3, axis=2) if image.shape[2] == 1 else image.copy()


def as_float(image: ArrayLike) -> np.ndarray:
    """Convert an image, as `as_rgb` takes it, to float32 RGB (h, w, 3) in 0..1."""
    return as_rgb(image).astype(np.float32) / 255


def crops(image: np.ndarray, boxes: ArrayLike, size: int) -> np.ndarray:
    """Crop boxes (n, 4) of a uint8 image (height, width, c): (n, size, size, c) in 0..1.

    A pixel is the mean of four samples spread evenly over it. Beyond the image its edge pixels
    repeat; a box without area shows the one pixel, or row of pixels, it lies on. ValueError for
    another kind of image.
    """
    if not isinstance(image, np.ndarray):
        raise ValueError(f"{short(image)} is no uint8 image: see photos.read_image")
    if image.dtype != np.uint8 or image.ndim != 3 or image.size == 0:
        raise ValueError(f"{image.dtype} {image.shape} is no uint8 image: see photos.read_image")
    check_count("size", size, least=1)
    boxes = as_boxes(boxes)
    height, width = image.shape[:2]
    steps = (np.arange(size * 2) + 0.5) / (size * 2)
    x, y = (
        (boxes[:, [low]] + steps * (boxes[:, [low + 2]] - boxes[:, [low]])).clip(0, limit - 1)
        for low, limit in ((0, width), (1, height))
    )
    return _means_of_four(image, y.astype(int), x.astype(int)) / np.float32(255)


@compiled
def _means_of_four(image, y, x):
    size, channels = x.shape[1] // 2, image.shape[2]
    cells = np.empty((len(y), size, size, channels), np.float32)
    for box in range(len(y)):
        for i in range(size):
            above, below = image[y[box, 2 * i]], image[y[box, 2 * i + 1]]
            for j in range(size):
                left, right = x[box, 2 * j], x[box, 2 * j + 1]
                for c in range(channels):
                    one, other = int(above[left, c]) + above[right, c], below[left, c]
                    cells[box, i, j, c] = np.float32(one + other + below[right, c]) / 4
    return cells


def _open(path):
    if "://" in str(path):
        raise ValueError(f"{path} is an address: save the photo, and give the path of its file")
    try:
        path = Path(path).expanduser()
        if path.is_dir():
            raise ValueError(f"{path.absolute()} is a folder: name a file in it")
        with Image.open(path) as file:
            if file.mode[0] in "IF":
                raise ValueError(f"{path} holds more than 8 bits a channel: save it with 8")
            file.draft("RGB", (2 * WIDTH, 2 * HEIGHT))  # of a huge JPEG, not every pixel is read
            return as_rgb(to_srgb(ImageOps.exif_transpose(file)))
    except FileNotFoundError:
        raise ValueError(f"no photo at {path.absolute()}: is the name right?") from None
    except UnidentifiedImageError:
        remedy = "save it, or a phone's HEIC, as a JPEG or PNG"
        raise ValueError(f"{path} is not an image that can be read: {remedy}") from None
    except (OSError, RuntimeError, SyntaxError, Image.DecompressionBombError) as error:
        raise ValueError(f"{path} cannot be read ({error}): is the copy complete?") from None


def _letterbox(image):
    height, width = image.shape[:2]
    scale = min(WIDTH / width, HEIGHT / height)
    size = max(1, round(width * scale)), max(1, round(height * scale))
    page = Image.new("RGB", (WIDTH, HEIGHT), (128, 128, 128))
    resized = Image.fromarray(image).resize(size, Image.Resampling.LANCZOS)
    page.paste(resized, ((WIDTH - size[0]) // 2, (HEIGHT - size[1]) // 2))
    return np.array(page)
