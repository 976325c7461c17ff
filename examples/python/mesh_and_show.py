"""A soup becomes a mesh and a picture.

usage: mesh_and_show.py [SOUP] [PICTURE.png]      without arguments: the sample "tree", into tree.png
"""

import sys

import tetsoup


def main(soup_path="", picture="tree.png"):
    soup = tetsoup.read(soup_path) if soup_path else tetsoup.sample("tree")
    pipeline = tetsoup.Pipeline(soup)
    mesh = pipeline.run(tets=2000)
    pipeline.save_preview(picture, title=soup_path or "tree")
    print(mesh, "drawn in", picture)
    print("inside was told with k =", round(mesh.report.pseudo_volume.k, 3))
    for check in mesh.readiness().checks:
        print("ok  " if check.passed else "look", check.title, "=", round(check.value, 3))


if __name__ == "__main__":
    main(*sys.argv[1:])
