"""What every row is to reach, in milliseconds on a machine of two cores, for the bunny of 69K triangles. The ratios to
read(field) are what carries over to other machines."""

# (label, row, {voxels along the longest axis: ms}); None: the row has no grid.
STAGES = [
    ("read PLY", "read_ply", {None: 15}),
    ("read OBJ", "read_obj", {None: 25}),
    ("clean the soup", "clean_soup", {None: None}),
    ("distance, band of 3 voxels", "distance_band", {128: 60, 256: 150, 512: 500}),
    ("distance, full field", "distance_full", {128: 150, 256: 800, 512: 6000}),
    ("signs, one k, 26 rays", "signs_one_k", {128: 12, 256: 80, 512: 700}),
    ("signs, automatic k", "signs_auto", {128: 60, 256: 350, 512: 3000}),
    ("lattice and density, 3K tets", "lattice", {128: 10, 256: 40, 512: 250}),
    ("lattice with all that mends it, 3K tets", "lattice_mended", {}),
    ("smoothing at its defaults, 3K tets", "smooth", {128: 15}),
    ("**whole tool, file to file**", "tool", {64: 100, 128: 250, 256: 900, 512: 6000}),
]

SLIDERS = [
    ("k", "slider_k", 60),
    ("rho_min", "slider_rho_min", 40),
    ("translation", "slider_translate", 40),
    ("lattice size", "slider_cell_size", 40),
    ("smoothing", "slider_smoothing", 15),
]
SLIDER_VOXELS = 128

EMBEDDING = [
    ("hang on the tets, half of them outside", "embed", 300),
    ("hang on the tets, enclosed", "embed_enclosed", 300),
    ("move points", "deform_points", None),
    ("move normals", "deform_normals", None),
]
EMBEDDING_VOXELS = 128

# (label, row, times real time at least)
SCENES = [
    ("`drop`", "play_drop", None),
    ("`robots-on-tree`", "play_robots-on-tree", 10),
    ("`robots-on-tree-massive`", "play_robots-on-tree-massive", 0.5),
    ("`stack`", "play_stack", None),
    ("`twist`", "play_twist", None),
    ("`cantilever`", "play_cantilever", None),
    ("`drop` with 10,000 tets", "play_drop_10k", 10),
]
BENDING = [("3,000 tets", "bend_3k"), ("10,000 tets", "bend_10k"), ("100,000 tets", "bend_100k")]

TOOL_TETS = {64: 5000}  # on other grids:
DEFAULT_TETS = 3000

PEAK_MB = {256: 300, 1024: 4000}
SIGNS_1024_SECONDS = 40
SCALING = 1.7          # two threads over one, at least
OVERSUBSCRIBED = 1.1   # more threads than cores over as many as cores, at most; a tenth is noise
GROWTH = 1.1           # per voxel, the largest grid over the smallest, at most; a tenth is noise
