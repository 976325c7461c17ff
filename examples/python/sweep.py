"""What k and rho_min do: a table of tets, parts and overlap, and slices through the votes.

One Pipeline serves the whole sweep: distances are computed once, votes once a k.

usage: sweep.py [SOUP] [PICTURE.png]      the picture needs matplotlib
"""

import sys

import tetsoup

BANDS = [1, 2, 4]  # voxels: the wider, the larger the gaps that count as closed
SHARES = [0.2, 0.5, 0.8]


def main(soup_path="", picture="sweep.png"):
    soup = tetsoup.read(soup_path) if soup_path else tetsoup.sample("tree")
    pipeline = tetsoup.Pipeline(soup)
    slices = []
    print("band   k      rho_min   tets   parts   overlap")
    for band in BANDS:
        for share in SHARES:
            mesh = pipeline.run(voxels=64, band_voxels=band, rho_min=share, cells=16)
            overlap = tetsoup.overlap(mesh, pipeline.pseudo_volume)
            k = mesh.report.pseudo_volume.k
            print(f"{band:<6} {k:<6.3f} {share:<9} {len(mesh.tets):<6} {mesh.quality.components:<7} {overlap:.3f}")
        votes = pipeline.pseudo_volume.votes
        slices.append(votes[:, votes.shape[1] // 2])  # (z, x)
    print("distances were computed", pipeline.run_counts["distance"], "time(s)")
    draw(slices, picture)


def draw(slices, picture):
    try:
        import matplotlib
    except ImportError:
        print("no picture: matplotlib is not installed")
        return
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(slices), figsize=(4 * len(slices), 4))
    for axis, votes, band in zip(axes, slices, BANDS):
        axis.imshow(votes, origin="lower", vmin=0, vmax=26)
        axis.set_title(f"votes, band {band} voxels")
    figure.savefig(picture)
    print("drawn in", picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
