"""Training the name classifier: logistic regression on jittered crops of objects and scene."""

import numpy as np

from vmc_lib import photos
from vmc_lib.boxes import iou, jitter_boxes
from vmc_lib.what.crops import crop
from vmc_lib.what.recogniser import NameClassifier

INVERSE_PENALTIES = 10.0 ** np.arange(-1, 5)
COPIES, JITTER = 4, 0.08  # training boxes: copies of each, and how far their sides stray


def background_box(shot, rng):
    """A box of a likely size that overlaps with no object (IoU below 0.3)."""
    objects = np.array(list(shot.boxes.values()))
    while True:
        width, height = rng.uniform(50, 180, 2)
        x, y = rng.uniform(0, photos.WIDTH - width), rng.uniform(0, photos.HEIGHT - height)
        if (iou([(x, y, x + width, y + height)], objects) < 0.3).all():
            return np.array([x, y, x + width, y + height])


def labelled_crops(shots, rng, copies=COPIES, background=0):
    """Crops (n, 200, 200) and labels (n,) from photos, True for a shuttlecock.

    Each object `copies` times, jittered and half of them mirrored; and so many crops of
    `background` a photo.
    """
    crops, labels = [], []
    for shot in shots:
        boxes = [(box, name == "shuttlecock") for name, box in shot.boxes.items()] * copies
        boxes = [(jitter_boxes(box, JITTER, rng), label) for box, label in boxes]
        boxes += [(background_box(shot, rng), False) for _ in range(background)]
        for box, label in boxes:
            picture = crop(shot.image, box)
            crops.append(picture[:, ::-1] if rng.random() < 0.5 else picture)
            labels.append(label)
    return np.array(crops), np.array(labels)


def fit_name_classifier(x, y, x_validation, y_validation):
    """A `NameClassifier` of features x (n, d) with labels y (n,), True for a shuttlecock.

    Logistic regression; of the INVERSE_PENALTIES the one with the best likelihood on the validation
    set is kept, and its probabilities are calibrated there with Platt's sigmoid (1999). ValueError
    for an empty set, NaN, or labels of one class only.
    """
    from sklearn.calibration import CalibratedClassifierCV
    from sklearn.frozen import FrozenEstimator
    from sklearn.linear_model import LogisticRegression

    for use, features, labels in (("train", x, y), ("validate", x_validation, y_validation)):
        if len(features) == 0 or len(np.unique(labels)) < 2 or not np.isfinite(features).all():
            raise ValueError(f"to {use}, give finite features of both classes")
    centre = x.mean(0)
    size = np.sqrt(np.square(x - centre).sum(1).mean())
    x, scaled = (x - centre) / size, (x_validation - centre) / size

    def fit_calibrated(strength):
        model = LogisticRegression(C=strength, max_iter=2000).fit(x, y)
        frozen = FrozenEstimator(model)  # so that parts matter not, and two of a kind are enough
        sigmoid = CalibratedClassifierCV(frozen, method="sigmoid", cv=2)
        sigmoid.fit(scaled, y_validation)
        platt = sigmoid.calibrated_classifiers_[0].calibrators[0]
        weights = -platt.a_ * model.coef_[0] / size
        bias = -platt.a_ * model.intercept_[0] - platt.b_ - weights @ centre
        return NameClassifier(weights, float(bias))

    def likelihood(classifier):
        logit = classifier.log_odds(x_validation)
        return -np.logaddexp(0, np.where(y_validation, -logit, logit)).sum()

    return max(map(fit_calibrated, INVERSE_PENALTIES), key=likelihood)
