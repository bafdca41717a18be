"""The CRBM against the paper's Eq. 1, taken at its word and enumerated state by state."""

import itertools

import numpy as np
import pytest
import torch
from scipy.signal import convolve2d

from vmc_lib.what.crbm import CRBM
from vmc_lib.what.learning import Learner


def rng(seed=0):
    return torch.Generator().manual_seed(seed)


def tiny(K=2, channels=1, n_w=2, c=2, size=1.0):
    """A machine of double precision with filters of no symmetry, small enough to enumerate."""
    draw = np.random.default_rng(K + 10 * channels + 100 * n_w)
    W, b, a = (
        draw.normal(0, size, (K, channels, n_w, n_w)),
        draw.normal(size=K),
        draw.normal(size=channels),
    )
    return Learner(*map(torch.from_numpy, (W, b, a)), c)


def picture(machine, rows, columns, n=1, seed=0):
    shape = n, len(machine.a), rows, columns
    return torch.from_numpy(np.random.default_rng(seed).normal(size=shape))


def energy_by_the_book(machine, v, h):
    """Eq. 1 for one v (channels, rows, columns) and one h, with a true convolution and W̃."""
    W, b, a = (x.numpy() for x in (machine.W, machine.b, machine.a))
    total = 0.0
    for k in range(len(b)):
        kernels = [np.rot90(W[k, channel], 2) for channel in range(len(a))]
        drive = sum(convolve2d(x, w, mode="valid") for x, w in zip(v, kernels, strict=True))
        total -= (h[k] * drive).sum() + b[k] * h[k].sum()
    return total - (a[:, None, None] * v).sum() + (v**2).sum() / 2


def allowed(K, rows, columns, c):
    """Every h (K, rows, columns) with at most one unit on in each c × c block."""
    blocks = list(itertools.product(range(K), range(0, rows, c), range(0, columns, c)))
    for choice in itertools.product(range(c * c + 1), repeat=len(blocks)):
        h = np.zeros((K, rows, columns))
        for (k, y, x), unit in zip(blocks, choice, strict=True):
            if unit < c * c:
                h[k, y + unit // c, x + unit % c] = 1
        yield h


CASES = [dict(), dict(channels=2), dict(K=1, n_w=3), dict(K=3, c=1), dict(K=1, c=3)]
SIZES = [(3, 5), (3, 5), (4, 6), (3, 3), (4, 7)]


@pytest.fixture(params=zip(CASES, SIZES, strict=True), ids=str)
def world(request):
    """A tiny machine, a picture, every allowed h and its Boltzmann factor."""
    case, size = request.param
    machine = tiny(**case)
    v = picture(machine, *size)
    edge = machine.W.shape[-1] - 1
    states = np.array(list(allowed(len(machine.b), size[0] - edge, size[1] - edge, machine.c)))
    energies = np.array([energy_by_the_book(machine, v[0].numpy(), h) for h in states])
    return machine, v, states, energies


def test_energy_is_equation_1(world):
    machine, v, states, energies = world
    ours = machine.energy(v.expand(len(states), -1, -1, -1), torch.from_numpy(states))
    assert ours.numpy() == pytest.approx(energies, abs=1e-9)


def test_posterior_and_pooling_probabilities(world):
    machine, v, states, energies = world
    chance = np.exp(energies.min() - energies)
    chance /= chance.sum()
    h, p = machine.posterior(v)
    assert h[0].numpy() == pytest.approx(np.tensordot(chance, states, 1), abs=1e-9)
    K, rows, columns = states.shape[1:]
    c = machine.c
    pooled = states.reshape(-1, K, rows // c, c, columns // c, c).max((3, 5))
    for alone in (p, machine.pooled(v)):
        assert alone[0].numpy() == pytest.approx(np.tensordot(chance, pooled, 1), abs=1e-9)


def test_extreme_preactivations_do_not_overflow():
    """In single precision a number over e to the 88 overflows: the chances are 1 and 0."""
    machine = CRBM(*(np.ones(n, np.float32) for n in ((1, 1, 1, 1), 1, 1)))
    with np.errstate(all="raise", under="ignore"):
        for z, chance in ((1e4, 1), (90, 1), (-1e4, 0)):
            v = np.full((1, 1, 2, 2), z, np.float32)
            assert machine.pooled(v) == machine.posterior(v)[1] == chance


def test_samples_follow_the_posterior(world):
    machine, v, *_ = world
    on, _ = machine.posterior(v)
    h = machine.sample(on.expand(20_000, -1, -1, -1), rng())
    assert set(h.unique().tolist()) == {0.0, 1.0}
    assert torch.nn.functional.max_pool2d(h, machine.c).sum((2, 3)).eq(h.sum((2, 3))).all()
    assert h.mean(0).numpy() == pytest.approx(on[0].numpy(), abs=5 * 0.5 / np.sqrt(20_000))


def test_visible_mean_of_one_hidden_unit_is_its_filter():
    machine = tiny(K=2, channels=2, n_w=3)
    h = torch.zeros(1, 2, 2, 4, dtype=torch.double)
    h[0, 1, 0, 2] = 1
    painted = machine.visible_mean(h) - machine.a[:, None, None]
    assert torch.equal(painted[0, :, 0:3, 2:5].round(decimals=9), machine.W[1].round(decimals=9))
    assert painted.count_nonzero() == machine.W[1].numel()


# ---------------------------------------------------------------- the log-likelihood


def model_states(W, b, a, rows, columns, c):
    """Every allowed h, the mean of v given each, and the log of each one's unnormalised chance.

    Given h, v is Gaussian, so its integral is known. Filters are painted by slicing, without the
    library, and everything can be differentiated.
    """
    K, _, n_w, _ = W.shape
    states = torch.from_numpy(np.array(list(allowed(K, rows - n_w + 1, columns - n_w + 1, c))))
    mean = a[:, None, None] + torch.zeros(len(states), len(a), rows, columns, dtype=W.dtype)
    for y, x in np.ndindex(*states.shape[2:]):
        painted = torch.einsum("sk,kcij->scij", states[:, :, y, x], W)
        mean = mean + torch.nn.functional.pad(painted, (x, columns - n_w - x, y, rows - n_w - y))
    on = torch.einsum("skij,k->s", states, b)
    return states, mean, mean.square().sum((1, 2, 3)) / 2 + on


def log_likelihood(W, b, a, v, c):
    """The exact mean of log p(v): p is a mixture of Gaussians around the means, one for each h."""
    _, mean, chance = model_states(W, b, a, *v.shape[2:], c)
    distance = (v[:, None] - mean).square().sum((2, 3, 4)) / 2
    log_p = torch.logsumexp(torch.log_softmax(chance, 0) - distance, 1)
    return log_p.mean() - v[0].numel() / 2 * np.log(2 * np.pi)


def differentiable(machine):
    return [x.clone().requires_grad_() for x in (machine.W, machine.b, machine.a)]


def exact_gradient(machine, v):
    parameters = differentiable(machine)
    return torch.autograd.grad(log_likelihood(*parameters, v, machine.c), parameters)


def test_gradient_is_data_minus_model():
    """What goes together in the data, less what does in the model: the gradient of log p."""
    machine = tiny(K=2, n_w=2, size=0.7)
    v = picture(machine, 3, 5, n=5)
    states, mean, chance = model_states(machine.W, machine.b, machine.a, 3, 5, machine.c)
    parameters = differentiable(machine)
    energies = Learner(*parameters, machine.c).energy(mean, states)
    model = torch.autograd.grad(-(torch.softmax(chance, 0) @ energies), parameters)
    for data, dream, truth in zip(
        machine.statistics(v, machine.posterior(v)[0]),
        model,
        exact_gradient(machine, v),
        strict=True,
    ):
        assert (data - dream).numpy() == pytest.approx(truth.numpy(), abs=1e-9)


def test_longer_chains_come_closer_to_the_exact_gradient():
    machine = tiny(K=2, n_w=2, size=0.8)
    v = picture(machine, 3, 3, n=4)
    exact = torch.cat([x.flatten() for x in exact_gradient(machine, v)])
    gaps = []
    for steps in (1, 4, 40):
        estimate, *_ = machine.gradient(v.repeat(5_000, 1, 1, 1), steps, rng(steps))
        gaps.append((torch.cat([x.flatten() for x in estimate]) - exact).norm().item())
    assert gaps[0] > gaps[1] > gaps[2]
    assert gaps[2] < 0.05 * exact.norm()


def test_fit_raises_the_likelihood_of_the_data():
    bars = torch.zeros(400, 1, 3, 3, dtype=torch.double)
    bars[:200, :, :, 1], bars[200:, :, 1, :] = 2, 2
    bars += 0.3 * torch.randn(bars.shape, generator=rng(1), dtype=torch.double)
    machine = tiny(K=2, n_w=2, size=0.1)

    def likelihood():
        return log_likelihood(machine.W, machine.b, machine.a, bars, machine.c).item()

    before = likelihood()
    machine.fit(bars, range(10), seed=0, pressure=0, clamp=False)
    assert likelihood() > before + 0.5


# ---------------------------------------------------------------- errors


def test_wrong_shapes_are_refused():
    machine = Learner.random(2, 1, 4, rng())
    with pytest.raises(ValueError, match="trim"):
        machine.posterior(torch.zeros(1, 1, 8, 8))
    assert machine.trim(torch.zeros(1, 1, 8, 9)).shape == (1, 1, 7, 9)
    with pytest.raises(ValueError, match="v is"):
        machine.posterior(torch.zeros(1, 2, 9, 9))
    with pytest.raises(ValueError, match="hidden width"):
        machine.posterior(torch.zeros(1, 1, 3, 3))
    with pytest.raises(ValueError, match="belong"):
        Learner(torch.zeros(2, 1, 4, 4), torch.zeros(3), torch.zeros(1))
