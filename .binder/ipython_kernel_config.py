"""In a live kernel an edited file of the library counts when the next cell runs or demo is moved.

What every chapter shows with is imported while the kernel starts, before the reader runs anything,
and the arm moves once, so that its machine code is loaded. A name that a cell with a syntax error
would have defined is told with that error.
JupyterLab writes what a kernel says of itself into the notebook: ours leave out the one thing that
changes from reader to reader, or each notebook would be changed as soon as it is opened.
"""

from ipykernel.ipkernel import IPythonKernel

IPythonKernel.language_info.pop("version", None)

c = get_config()  # noqa: F821
c.InteractiveShellApp.extensions = ["autoreload"]
c.InteractiveShellApp.exec_lines = [
    "%autoreload 2",
    "import vmc_lib.show, vmc_lib.motor.templates",
    "vmc_lib.motor.templates.load()",
    "vmc_lib.show.questions.explain_unknown_names(get_ipython())",
]
