import numpy as np
import torch

from reproduce.measures.grating_response import answers, modulation
from vmc_lib.what.learning import Learner


def gabor_crbm(scale):
    """One filter: upright stripes of half a cycle in 4 pixels."""
    stripes = torch.cos(torch.arange(8) * 2 * torch.pi / 8).expand(1, 1, 8, 8)
    return Learner(scale * stripes, torch.tensor([-2.0]), torch.zeros(1))


def test_a_unit_answers_most_to_stripes_of_its_own_direction():
    along, across = (answers(gabor_crbm(0.1), 1, 1 / 8, angle)[0] for angle in (0, np.pi / 2))
    assert (along > across).all()


def test_a_unit_that_follows_the_stripes_is_simple():
    hidden, pooled = modulation(gabor_crbm(0.2), 1)
    assert hidden > 1
    assert pooled < hidden
