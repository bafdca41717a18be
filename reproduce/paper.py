"""The published numbers of Wu, Qiao et al., each with its table and unit; nothing of ours.

Lengths are in the paper's own unit of length, which is not the metre of our arm (its hand is 1.2
units from the origin, ours reaches 0.53 m): across the two, only ratios of errors compare.
"""

import numpy as np

# Half a unit of the last digit that is printed: of shares in Tables I and II, in Table III, and of
# lengths
SHARE, SHARE_3, LENGTH = 0.00005, 0.0005, 0.00005

# Block 1-1 and Section IV A: localisation
PHOTOS = 80  # 40 to train, 40 to test
BOXES_PER_PHOTO = 130  # "in average"; 10,560 boxes in all
TRAINING_ROIS = {"positive": 224, "negative": 4707}
TEST_ROIS = {"positive": 232, "negative": 4702}

TABLE_1 = {  # kernel of the RoI classifier -> (precision, recall), before suppression
    "Gaussian": (0.9306, 0.8664),
    "RBF": (1.0, 0.9353),
    "polynomial": (0.9774, 0.9310),
    "linear": (1.0, 0.9353),
}
TABLE_2 = (1.0, 0.9494)  # precision, recall of selective search + classifier + suppression

OBJECTS = 79  # test objects, not printed: 75/79 = 94.94 %

# Block 1-2 and Section IV B: recognition
TABLE_3 = {"CDBN": (0.988, 1.0), "HMAX": (0.975, 1.0)}  # precision, recall
MAPS = 10  # K
POOL = 2  # c
FILTER_WIDTH = 8  # n_w in Fig. 7
PROJECTED_WIDTH = 23  # a unit of the second layer seen in the image, Fig. 7
CROP_WIDTH = 200

# Blocks 2-3 and Section IV C-D: movement. Five examples, a column each.
TARGETS = np.array(
    [[0.8634, -0.7487], [0.9132, -0.7849], [0.8565, -0.7940], [0.9518, -0.7336], [0.8906, -0.7698]]
)
# Rows are the four templates. Columns 2 and 3 of Table IV do not sum to one (1.119 and 0.850):
# the 0.4503 most likely belongs to column 3.
TABLE_4_WEIGHTS = np.array(
    [
        [0.2677, 0.3172, 0.1673, 0.1848, 0.3473],
        [0.3340, 0.4503, 0.3002, 0.2853, 0.2367],
        [0.2095, 0.2167, 0.2113, 0.3680, 0.2131],
        [0.1888, 0.1351, 0.1712, 0.1619, 0.2029],
    ]
)
TABLE_4_ERRORS = np.array([0.0156, 0.0709, 0.0357, 0.0686, 0.0569])  # planned
TABLE_5_WEIGHTS = np.array(
    [
        [0.2470, 0.3589, 0.1115, 0.2018, 0.3814],
        [0.3435, 0.3295, 0.5630, 0.3143, 0.2534],
        [0.2061, 0.2125, 0.1221, 0.4019, 0.2185],
        [0.1905, 0.0438, 0.1659, 0.0444, 0.1058],
    ]
)
TABLE_5_ERRORS = np.array([0.0040, 0.0256, 0.0157, 0.0395, 0.0147])  # after off-line calibration
TABLE_6_ERRORS = np.array([0.0093, 0.0181, 0.0152, 0.0414, 0.0125])  # after online calibration
TABLE_6_WEIGHTS = np.array(  # after it; as in Table IV, and the columns sum to less than one
    [
        [0.2666, 0.3166, 0.1575, 0.1794, 0.3545],
        [0.3365, 0.3255, 0.5504, 0.3179, 0.2599],
        [0.2078, 0.2210, 0.1293, 0.3884, 0.2241],
        [0.1795, 0.0851, 0.1482, 0.0749, 0.1186],
    ]
)
MEAN_ERROR = {"planned": 0.0393, "off-line": 0.0234, "online": 0.0238}  # over all 25 movements
MEAN_OF_FIVE = {"planned": 0.0496, "off-line": 0.0199, "online": 0.0193}  # over those printed
TEMPLATES = 4  # N


def planned_error_ratio() -> float:
    """Mean planned error of all movements over the mean distance of the five printed targets."""
    return MEAN_ERROR["planned"] / float(np.linalg.norm(TARGETS, axis=1).mean())


def calibrated_error_ratio(kind: str) -> float:
    """Mean error after "off-line" or "online" calibration, over the planned one (Tables IV-VI)."""
    return MEAN_ERROR[kind] / MEAN_ERROR["planned"]


def ratio_rounding(*kinds) -> float:
    """What rounding can change of a ratio of two mean errors, such as "off-line" over "planned"."""
    above, below = (MEAN_ERROR[kind] for kind in kinds)
    return above / below * (LENGTH / above + LENGTH / below)


def planned_rounding() -> float:
    """What rounding can change of `planned_error_ratio`."""
    return LENGTH / float(np.linalg.norm(TARGETS, axis=1).mean())
