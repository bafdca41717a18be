"""Rendering of the photos: a shuttlecock, a cup and what else lies about, rendered physically.

`meshes` makes triangles, `shuttlecocks` and `objects` things of them, `materials` table tops;
`scene` draws what stands where before which camera and light, `picture` traces the light, and
`sidecar` writes the truth beside the photo. Needs the optional dependency `mitsuba`
(`pip install -e ".[render]"`) and LLVM; remake with `python -m reproduce.render`. `elsewhere`
paints other scenes, with the things of `furniture`, by VTK; `cutouts` renders
shuttlecocks and `decoys` alone.
"""
