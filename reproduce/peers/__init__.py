"""Rival models and baselines, which the book's are compared with.

`baseline_features` and `hmax` name crops, `window_proposals` lists candidates, `muscle_models` pull
by other laws, `adaptive_controllers` learn where to aim; `optimal_control`, `minimum_variance` and
`lqr_tracking` choose other commands, the last two against `motor_noise`; `lqg` corrects them by
what late senses and `state_estimation` say.
"""
