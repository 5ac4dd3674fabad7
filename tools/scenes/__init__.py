"""The geometry of the scenes in config/scenes; tools/make_scenes.py writes the files."""
