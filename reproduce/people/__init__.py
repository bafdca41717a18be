"""What was measured of people, with its source: numbers that the page on people puts beside ours.

Each source was opened. What may be stored is in `measurements.json`; of the rest only the few
numbers that are compared stand here, as facts, with the sentence that they come from.
"""

from typing import NamedTuple

from reproduce import results


class Source(NamedTuple):
    """Where numbers come from, and how they were read."""

    title: str
    url: str  # what was opened
    people: str  # how many, and of which kind
    bars: str  # what the error bars are
    licence: str
    how: str  # how the numbers were read


MISSES, HITS = "misses the target", "lies within the target"  # of three groups of CLAMP

CLAMP = Source(
    "Kim, Parvin and Ivry 2019, experiment 1",
    "https://github.com/hyosubkim/Influence-of-task-outcome-on-implicit-motor-learning",
    "48 people, 16 in each of three groups",
    "standard error over people",
    "MIT, Copyright (c) 2019 hyosubkim",
    "the data of https://elifesciences.org/articles/39882, commit 8fe43dc0; worked out from "
    "e1_data.mat as the authors' e1_analyze.m does: hand angle at peak radial "
    "speed, trials more than three standard deviations off a running mean of five left out, the "
    "mean of cycles 7 to 15 of each person and target taken away, the sign turned so that "
    "positive is away from what is shown; then the mean of a cycle of eight targets. Stored: "
    "cycle 15 (seen), 80 clamped at 3.5 degrees, 5 with no feedback, 10 seen; and of each "
    "person the standard deviation of the angle in the first five reaches to a target, without "
    "feedback, mean over the eight targets",
)
ROTATION = Source(
    "'t Hart and Henriques, the data set tworatedata of the R package SMCL, version 2022.3.11",
    "https://github.com/thartbm/SMCL",
    "17 people",
    "standard error over people",
    "GPL-3 (the package): means only, as facts, are stored here",
    "commit 7ff6d4c4; worked out from data/tworatedata.rda: the mean of trials 17 to 32 of each "
    "person taken away, then means of four trials; stored: the last two fours before, 25 at a "
    "rotation of 30 degrees, 3 at the opposite one, 5 with the error clamped to zero",
)
SCATTER = Source(
    "van Beers, Haggard and Wolpert 2004",
    "https://research.vu.nl/en/publications/the-role-of-execution-noise-in-movement-variability",
    # fifteen: https://www.bohrium.com/paper-details/the-role-of-execution-noise-in-movement-
    # variability/812369203108511744-8768
    "15 people, 32 directions",
    "none printed in the abstract",
    "a number as a fact",
    "the abstract: 'The variability in the movement endpoints and in the initial movement "
    "direction varied systematically with the movement direction, with some directions having up "
    "to twice the variability of others.'",
)
SPEED = Source(
    "Nagasaki 1989",
    "https://p.pdfhall.com/asymmetric-velocity-and-acceleration-profiles-of-human-citeseerx_"
    "5b66ecfe097c4710488b4570.html",
    "not said in the abstract",
    "none printed in the abstract",
    "a number as a fact",
    "the abstract: 'Relative time to peak velocity or relative duration of acceleration, k, was "
    "approximately 0.5 for the movements with intermediate speed (about 0.5 s in movement time), "
    "i.e., symmetric velocity and acceleration profiles. For the slow and ballistic movements, k "
    "shifted towards values below and above 0.5, respectively'",
)
JUMP = Source(
    "Mon-Williams, Murphy and Hibbard",
    "https://www.win.ox.ac.uk/publications/1119923",
    "not said in the abstract; reaches of 46 cm",
    "none printed in the abstract",
    "numbers as facts",
    "the abstract: 'the system implemented corrections in the deceleration phase of the movement "
    "(circa 230ms) although the system is capable of modifying a trajectory as early as 110ms'",
)
SIZE = Source(
    "Kim et al. 2018",
    "https://pubmed.ncbi.nlm.nih.gov/30271906/",
    "healthy people; how many is not said in the abstract",
    "none printed in the abstract",
    "statements as facts",
    "the abstract: 'the size of adaptive corrections is only related to error size when errors "
    "are smaller than 6 degrees, and learning functions converge to a similar level of asymptotic "
    "learning over a wide range of error sizes'",
)

MEASUREMENTS = results.records("measurements", folder=__path__[0])
