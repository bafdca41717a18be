"""The arms in the page, as the book shows them."""

import pytest

from book.figures import whole_arm_live
from page.arm import live, live_arm, live_whole_arm
from reproduce.whole_arm import experiment, habits
from tests import pages
from tests.page.arm.controls import TARGET, WHOLE_ARM_TARGET

# `arm` and `templateSet` for a script that asks them something, made once a page and arm
ASK = """async ([which, asked]) => {
  const given = JSON.parse(document.querySelectorAll(".vmc-live script")[which].textContent);
  const arm = await ((self.testArms ??= {})[which] ??= vmc["arm/load"].load(given));
  const [planning, muscle, calibration, kinematics] =
    ["planning", "muscle", "calibration", "kinematics"].map((name) => vmc[`arm/${name}`]);
  const templateSet = await vmc["arm/templates"].load(given.templateSet);
  const reach = (plan) => (weights) => {
    const moments = arm.reach(templateSet.excitations({ ...plan, weights }));
    return arm.hold(moments);
  };
  %s
}"""


@pytest.fixture(scope="session")
def past():
    """The whole arm's templates."""
    return habits.load_templates()


@pytest.fixture(scope="session")
def arms_html(past):
    def declare():
        live_arm("bench")
        live_arm("reach", TARGET)
        live_whole_arm(
            whole_arm_live.arm(past, habits.muscle_synergies().rest),
            lambda: whole_arm_live.pictures(past, WHOLE_ARM_TARGET),
            experiment.INSIDE,
            WHOLE_ARM_TARGET,
            "A whole arm before two views of it.",
        )
        live_arm("weights", TARGET)
        live_arm("templates", TARGET)

    return pages.book_html(live, declare)


@pytest.fixture(scope="module")
def ask(offline, site, arms_html):
    """A function that runs a script beside a loaded arm and returns its answer."""
    page = pages.open_html(offline, site, arms_html)
    yield lambda script, asked=(), arm=0: page.evaluate(ASK % script, [arm, asked])
    page.close()
    assert page.errors == []


@pytest.fixture
def open_arms(open_page, arms_html):
    """A function that opens a page with an arm for each mode, `past` for templates, and `whole`."""

    def open_arms(*window):
        page = open_page(arms_html, *window)
        arms = page.locator(".vmc-live").all()
        page.bench, page.reach, page.whole, page.by_hand, page.past = arms
        return page

    return open_arms
