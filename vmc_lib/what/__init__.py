"""The "what" pathway (ventral): crops, CRBMs, the deep belief network, the name."""

import torch

# Its threads meet at thousands of barriers a second, and each waits spinning: with one other busy
# process beside them a layer that learns in 12 s took over 330 s; with one thread, 14 s.
torch.set_num_threads(1)
