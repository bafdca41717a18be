"""What the model is held beside.

`features` and `hmax` name crops, `windows` lists candidates, `muscles` pull by other laws,
`cerebella` learn where to aim; `optimal`, `steady` and `optimal_feedback` choose other commands.
"""
