"""The stages one by one, the pipeline, and what is drawn from them."""

from __future__ import annotations

import threading

import numpy as np
import pytest
import tetsoup


@pytest.fixture
def torus():
    return tetsoup.sample("torus")


def test_stages_one_by_one_give_what_one_call_gives(torus):
    soup = tetsoup.clean_soup(*torus)
    field = tetsoup.unsigned_distance(soup, voxels=48)
    volume = tetsoup.classify_volume(field, placement="entry")
    while volume.report.wants_band_voxels:
        field = tetsoup.widen_distance(field, soup, volume.report.wants_band_voxels)
        volume = tetsoup.classify_volume(field, placement="entry")
    pipeline = tetsoup.Pipeline(*torus)
    whole = pipeline.run(voxels=48, cells=12, placement="entry")  # events alone, as the stages by themselves
    assert np.array_equal(volume.votes, pipeline.pseudo_volume.votes)
    lattice, report = tetsoup.fill_lattice(volume, soup, cells=12)
    assert report.tet_count == len(lattice.tets)
    assert np.array_equal(lattice.points, pipeline.lattice.mesh.points)
    assert np.array_equal(lattice.tets, whole.tets)
    smoothed, _ = tetsoup.smooth(lattice, volume, soup)
    assert np.array_equal(smoothed.points, whole.points)
    faired, _ = tetsoup.smooth(lattice, passes=2)
    assert faired.quality.volume == pytest.approx(lattice.quality.volume, rel=1e-3)
    assert not np.array_equal(faired.points, whole.points)


def test_the_distance_between_boundary_and_soup_is_measured(torus):
    volume = tetsoup.classify_volume(tetsoup.unsigned_distance(torus, voxels=48), band_voxels=1)
    lattice, report = tetsoup.fill_lattice(volume, torus, cells=12)
    smoothed, _ = tetsoup.smooth(lattice, volume)
    raw, fitted = (tetsoup.boundary_distance(mesh, torus) for mesh in (lattice, smoothed))
    assert 0 < fitted.mean < fitted.percentile95 < raw.percentile95
    in_edges = tetsoup.boundary_distance(lattice, torus, unit=report.mean_edge)
    assert in_edges.mean == pytest.approx(raw.mean / report.mean_edge)
    with pytest.raises(ValueError, match="enclosed has the shape"):
        tetsoup.smooth(lattice, enclosed=[1, 2, 3])


def test_fields_are_indexed_z_y_x_and_know_where_they_are(torus):
    field = tetsoup.unsigned_distance(torus, voxels=32, distance_mode="full")
    values = field.values
    assert (values.dtype, values.shape, values.flags.c_contiguous) == (np.float32, field.shape, True)
    z, y, x = np.indices(field.shape)
    x, y, z = np.array(field.origin)[:, None, None, None] + field.voxel_size * np.array([x, y, z])
    truth = np.abs(np.hypot(np.hypot(x, y) - 56.5, z) - 18.5)
    assert np.abs(values - truth).max() < 1  # the sample has flat facets
    assert field.shape[2] > 2 * field.shape[0]
    assert field.band == np.inf and values[2:-2, 2:-2, 2:-2].max() == pytest.approx(field.d_max, rel=1e-3)


def test_votes_and_inside_agree(torus):
    volume = tetsoup.classify_volume(tetsoup.unsigned_distance(torus, voxels=32), band_voxels=1)
    votes, inside = volume.votes, volume.inside
    assert (votes.dtype, inside.dtype, votes.shape) == (np.uint8, np.bool_, volume.shape)
    assert volume.rays == 26 and votes.max() == 26
    assert inside.sum() == volume.report.inside_voxels
    assert (inside >= (votes > 13)).all()
    assert volume.report.volume == pytest.approx(2 * np.pi**2 * 56.5 * 18.5**2, rel=0.1)


def test_too_narrow_a_band_says_how_wide_it_must_be(torus):
    field = tetsoup.unsigned_distance(torus, voxels=32)
    with pytest.raises(ValueError, match="band"):
        tetsoup.classify_volume(field, band_voxels=6)
    wider = tetsoup.widen_distance(field, torus, 8)
    assert tetsoup.classify_volume(wider, band_voxels=6).report.band_voxels == pytest.approx(6)
    assert field.band < wider.band


def test_a_pipeline_repeats_only_what_changed(torus):
    pipeline = tetsoup.Pipeline(*torus)
    first = pipeline.run(voxels=32, cells=8)
    kept = first.points.copy()
    pipeline.run(voxels=32, cells=10)
    assert pipeline.run_counts["distance"] == 1 and pipeline.run_counts["lattice"] == 2
    assert np.array_equal(first.points, kept)
    assert set(pipeline.seconds) == set(pipeline.run_counts)
    assert 0.5 < tetsoup.overlap(pipeline.mesh, pipeline.pseudo_volume) <= 1


def test_as_many_tets_as_the_shape_needs_are_found(torus):
    pipeline = tetsoup.Pipeline(*torus)
    mesh = pipeline.run(voxels=48, tets="auto")
    count = mesh.report.options["tets"]
    assert count in (500, 1000, 2000)
    assert len(mesh.tets) == pytest.approx(count, rel=0.05)
    assert mesh.points.tobytes() == pipeline.run(voxels=48, tets=count).points.tobytes()
    blurred = tetsoup.tetrahedralize(*tetsoup.sample("comb"), voxels=6, tets="auto")  # its gaps are half a voxel
    assert any("No count of tets" in note for note in blurred.report.notes)
    with pytest.raises(tetsoup.InvalidInput, match="tets"):
        pipeline.run(tets="many")
    with pytest.raises(tetsoup.InvalidInput, match="tets"):
        pipeline.run_until("lattice", tets="auto")


def test_results_that_do_not_stand_are_refused(torus):
    pipeline = tetsoup.Pipeline(*torus)
    for read in (
        lambda: pipeline.mesh,
        lambda: pipeline.lattice,
        lambda: pipeline.distance,
        lambda: pipeline.pseudo_volume,
        lambda: pipeline.save_preview("never.png"),
    ):
        with pytest.raises(ValueError, match="run"):
            read()
    pipeline.run_until("pseudo_volume", voxels=16)
    assert pipeline.pseudo_volume.shape == pipeline.distance.shape
    with pytest.raises(ValueError, match="run"):
        pipeline.mesh
    with pytest.raises(ValueError, match="stage = 'end'"):
        pipeline.run_until("end")
    pipeline.run(voxels=16)
    with pytest.raises(ValueError):
        pipeline.run(voxels=0)
    with pytest.raises(tetsoup.Cancelled):
        pipeline.run(voxels=20, progress=lambda stage, fraction: False)
    with pytest.raises(ValueError, match="run"):
        pipeline.mesh


def test_a_pipeline_lets_one_thread_in(torus):
    pipeline = tetsoup.Pipeline(*torus)
    refused = []

    def nosy(stage, fraction):
        with pytest.raises(RuntimeError, match="running"):
            pipeline.mesh
        refused.append(stage)

    pipeline.run(voxels=16, progress=nosy)
    assert refused


def test_pipelines_run_in_parallel_and_leave_the_interpreter_free(torus):
    meshes = {}

    def work(cells):
        meshes[cells] = tetsoup.tetrahedralize(*torus, voxels=32, cells=cells)

    threads = [threading.Thread(target=work, args=(cells,)) for cells in (6, 8, 10)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for cells, mesh in meshes.items():
        assert np.array_equal(mesh.points, tetsoup.tetrahedralize(*torus, voxels=32, cells=cells).points)


def test_pictures_and_fields_are_written_without_a_screen(torus, tmp_path):
    pipeline = tetsoup.Pipeline(*torus)
    pipeline.run(voxels=24)
    pipeline.save_preview(tmp_path / "torus.png", title="torus", width=800)
    pipeline.save_fields(tmp_path / "torus.vti")
    assert (tmp_path / "torus.png").read_bytes().startswith(b"\x89PNG")
    assert b"ImageData" in (tmp_path / "torus.vti").read_bytes()[:500]
    with pytest.raises(tetsoup.IoError):
        pipeline.save_preview(tmp_path / "nowhere" / "torus.png")
