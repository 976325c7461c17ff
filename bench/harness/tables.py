"""Rows into tables: Markdown for docs/PERFORMANCE.md, the same as aligned text on the terminal, and CSV."""
import csv
import re

from harness import targets

FACTS = ["date", "commit", "cpu", "cores", "simd", "compiler"]


class Results:
    def __init__(self, rows):
        self.rows = rows

    def find(self, what, voxels=0, soup="input", threads=0):
        for row in self.rows:
            if (row.what, row.voxels, row.soup, row.threads) == (what, voxels, soup, threads):
                return row
        return None

    def sizes(self, what, soup="input"):
        return sorted({row.voxels for row in self.rows if (row.what, row.soup) == (what, soup)})

    def read_field_ms(self):
        row = self.find("read_field")
        return row.best_ms if row else None


def ms(value):
    if value is None:
        return "–"
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 100 else f"{value:,.0f}"


def verdict(row, target):
    if target is None or row is None or row.best_ms is None:
        return ""
    if row.median_ms is not None and row.median_ms <= target:
        return "yes"
    return "best only" if row.best_ms <= target else "no"


def timing_cells(results, row, target):
    """target, best, median, multiple of read(field), met."""
    if row is None:
        return [ms(target), "given up", "–", "–", "" if target is None else "no"]
    if row.best_ms is None:
        return [ms(target), row.note, "–", "–", "" if target is None else "no"]
    field = results.read_field_ms()
    multiple = f"{row.best_ms / field:.2f}" if field else "–"
    return [ms(target), ms(row.best_ms), ms(row.median_ms), multiple, verdict(row, target)]


# --- the tables; each returns (header, rows) or None where nothing was measured ---------------------------------------

TIMES = ["target ms", "best ms", "median ms", "x read(field)", "met"]


def stages_table(results):
    lines = []
    measured = {row.voxels for row in results.rows}
    for label, what, sizes in targets.STAGES:
        for voxels in sorted({*sizes, *(results.sizes(what) if None not in sizes else [])}, key=lambda size: size or 0):
            if (voxels or 0) not in measured:
                continue
            row = results.find(what, voxels or 0)
            tets = f", {targets.TOOL_TETS.get(voxels, targets.DEFAULT_TETS) // 1000}K tets" if what == "tool" else ""
            grid = f"{voxels}^3" if voxels else "–"
            lines.append([label + tets, grid, *timing_cells(results, row, sizes.get(voxels))])
    return (["stage", "grid", *TIMES], lines) if lines else None


def sliders_table(results):
    lines = []
    for label, what, target in targets.SLIDERS:
        for voxels in results.sizes(what):
            at_target = target if voxels == targets.SLIDER_VOXELS else None
            lines.append([label, f"{voxels}^3", *timing_cells(results, results.find(what, voxels), at_target)])
    return (["slider", "grid", *TIMES], lines) if lines else None


def embedding_table(results):
    measured = [(label, results.find(what, targets.EMBEDDING_VOXELS), target) for label, what, target in targets.EMBEDDING]
    lines = [[label, *timing_cells(results, row, target)] for label, row, target in measured if row]
    return (["1M vertices", *TIMES], lines) if lines else None


def nanoseconds(row, milliseconds):
    """Wall time for a tet and substep, all threads."""
    return f"{milliseconds * 1e6 / row.counters['tets'] / row.counters['substeps']:.1f}"


def scenes_table(results):
    lines = []
    for label, what, target in targets.SCENES:
        row = results.find(what)
        if row is None or row.best_ms is None:
            continue
        best, median = (row.counters["seconds"] * 1e3 / time for time in (row.best_ms, row.median_ms))
        met = "" if target is None else "yes" if median >= target else "best only" if best >= target else "no"
        lines.append([label, f"{row.counters['tets']:,.0f}", f"{row.counters['skin_faces']:,.0f}",
                      f"{row.counters['contacts']:,.0f}", "–" if target is None else f"{target:g}", f"{best:.2f}",
                      f"{median:.2f}", nanoseconds(row, row.best_ms), met])
    header = ["scene", "tets", "faces of skins", "contacts a frame", "target x real time", "best x real time",
              "median x real time", "ns a tet and substep", "met"]
    return (header, lines) if lines else None


def bending_table(results):
    rows = [(label, results.find(what)) for label, what in targets.BENDING]
    lines = [[label, f"{row.counters['tets']:,.0f}", ms(row.best_ms), nanoseconds(row, row.best_ms),
              nanoseconds(row, row.cpu_ms)] for label, row in rows if row and row.best_ms]
    header = ["body", "tets", "ms a second", "ns a tet and substep", "of processor time"]
    return (header, lines) if lines else None


def same_results(rows):
    """Do rows of the same work agree on what came out? Counters that are times or rates are not among them."""
    return "yes" if all(row.counters == rows[0].counters for row in rows) else "NO"


def threads_table(results):
    lines = []
    for what in ("distance_band", "signs_one_k", "signs_auto"):
        for voxels in results.sizes(what):
            limited = sorted((row for row in results.rows if (row.what, row.voxels, row.soup) == (what, voxels, "input")
                              and row.threads and row.best_ms), key=lambda row: row.threads)
            if len(limited) < 3:
                continue
            one, two, many = limited[0], limited[1], limited[-1]
            every = results.find(what, voxels)
            gain, loss = one.best_ms / two.best_ms, many.best_ms / every.best_ms
            lines.append([what, f"{voxels}^3", ms(one.best_ms), ms(two.best_ms), f"{gain:.2f}",
                          "yes" if gain >= targets.SCALING else "no", f"{two.cpu_ms / one.cpu_ms:.2f}", str(many.threads), ms(many.best_ms), f"{loss:.2f}",
                          "yes" if loss <= targets.OVERSUBSCRIBED else "no", same_results([every, *limited])])
    header = ["stage", "grid", "1 thread ms", "2 threads ms", "gain", f"gain >= {targets.SCALING}",
              "processor time 2 over 1", "too many", "too many ms", "over all cores", f"<= {targets.OVERSUBSCRIBED}", "same result"]
    return (header, lines) if lines else None


def growth_table(results):
    """Nanoseconds a voxel, and bytes a voxel, over the sizes of grid."""
    whats = ["distance_band", "distance_full", "signs_one_k", "signs_auto", "lattice", "tool"]
    sizes = sorted({voxels for what in whats for voxels in results.sizes(what)})
    if len(sizes) < 2:
        return None

    def line(label, value_of):
        values = {voxels: value_of(voxels) for voxels in sizes}
        known = [value for value in values.values() if value is not None]
        ratio = known[-1] / known[0] if len(known) > 1 and known[0] else None
        cells = ["–" if values[voxels] is None else f"{values[voxels]:.3g}" for voxels in sizes]
        if ratio is None:
            return [label, *cells, "–", ""]
        return [label, *cells, f"{ratio:.2f}", "yes" if ratio <= targets.GROWTH else "no"]

    def voxel_count(voxels):
        row = results.find("distance_band", voxels) or results.find("tool", voxels)
        return row.counters.get("voxels") if row else None

    def per_voxel(what):
        def value_of(voxels):
            row, count = results.find(what, voxels), voxel_count(voxels)
            return row.best_ms * 1e6 / count if row and row.best_ms and count else None
        return value_of

    def bytes_per_voxel(voxels):
        row, count = results.find("tool", voxels), voxel_count(voxels)
        return row.peak_mb * 2**20 / count if row and row.peak_mb and count else None

    lines = [line(f"{what}, ns a voxel", per_voxel(what)) for what in whats if results.sizes(what)]
    lines.append(line("tool, peak bytes a voxel", bytes_per_voxel))
    header = ["", *(f"{voxels}^3" for voxels in sizes), "last over first", f"<= {targets.GROWTH}"]
    return header, lines


def memory_table(results):
    lines = []
    for voxels in results.sizes("tool"):
        row = results.find("tool", voxels)
        if row.peak_mb is None:
            lines.append([f"{voxels}^3", row.note, "–", "–", "–", "–"])
            continue
        limit, signs = targets.PEAK_MB.get(voxels), results.find("tool_pseudo_volume", voxels)
        met = "" if limit is None else "yes" if row.peak_mb <= limit else "no"
        lines.append([f"{voxels}^3", "–" if limit is None else f"{limit:,}", f"{row.peak_mb:,.0f}", met,
                      f"{row.best_ms / 1e3:.2f}", f"{signs.best_ms / 1e3:.2f}" if signs else "–"])
    header = ["grid", "target MB", "peak MB", "met", "whole tool s", "of it signs, automatic k s"]
    return (header, lines) if lines else None


def soups_table(results):
    lines = []
    for soup in ("one_triangle", "input", "many_triangles"):
        for voxels in results.sizes("distance_band", "many_triangles"):
            cells = []
            for what in ("distance_band", "signs_one_k", "signs_auto", "lattice", "smooth", "tool"):
                row = results.find(what, voxels, soup)
                cells.append(ms(row.best_ms) if row and row.best_ms is not None else row.note if row else "–")
            row = results.find("tool", voxels, soup)
            peak = f"{row.peak_mb:,.0f}" if row and row.peak_mb else "–"
            lines.append([soup.replace("_", " "), f"{voxels}^3", *cells, peak])
    header = ["soup", "grid", "distance, band ms", "signs, one k ms", "signs, auto ms", "lattice ms", "smooth ms",
              "whole tool ms", "peak MB"]
    return (header, lines) if any(line[2] != "–" for line in lines) else None


def kernels_table(results):
    names = {}
    for row in results.rows:
        if row.what.startswith("kernel_") and row.best_ms is not None:
            kernel, target = row.what.removeprefix("kernel_").split("_on_")
            names.setdefault(kernel, {})[target] = row.best_ms
    targets_seen = list(dict.fromkeys(target for found in names.values() for target in found))
    # A thousand calls in milliseconds are nanoseconds a call, times a thousand.
    lines = [[kernel, *(ms(found.get(target) and found[target] * 1e3) for target in targets_seen)]
             for kernel, found in names.items()]
    return (["kernel, ns a call", *targets_seen], lines) if lines else None


def breakdown_table(results):
    stages = ["read", "soup", "distance", "pseudo_volume", "lattice", "smooth", "quality", "write", "total"]
    lines = []
    for voxels in results.sizes("tool_total"):
        found = [results.find("tool_" + stage, voxels) for stage in stages]
        lines.append([f"{voxels}^3", *(ms(row.best_ms) if row else "–" for row in found)])
    header = ["grid", *(stage.replace("_", " ") + " ms" for stage in stages)]
    return (header, lines) if lines else None


def machine_lines(facts, results):
    lines = [f"- {key}: {facts[key]}" for key in FACTS]
    lines.append(f"- load when the run began: {facts['load']}")
    field = results.read_field_ms()
    if field:
        lines.append(f"- **read(field): {field:.2f} ms**, {256**3 * 4 / field / 1e6:.1f} GB/s"
                     + (f" (one core alone {results.find('read_field', threads=1).best_ms:.2f} ms)"
                        if results.find("read_field", threads=1) else ""))
    if facts.get("input"):
        lines.append(f"- input: {facts['input']}")
    return lines


TABLES = [
    ("stages", "Stages against their targets", stages_table),
    ("sliders", "Slider steps, distance known, 3K tets", sliders_table),
    ("embedding", "Embedding a million vertices, 3K tets", embedding_table),
    ("scenes", "Scenes, skins moved every frame, nothing drawn", scenes_table),
    ("bending", "Bending alone", bending_table),
    ("memory", "Peak memory of the tool", memory_table),
    ("growth", "Growth with the grid", growth_table),
    ("threads", "Threads", threads_table),
    ("soups", "Few and many triangles", soups_table),
    ("kernels", "Kernels on each instruction set", kernels_table),
    ("breakdown", "Where the tool's time goes", breakdown_table),
]


# --- how tables are written ------------------------------------------------------------------------------------------

def markdown(table):
    header, lines = table
    return "\n".join(["| " + " | ".join(header) + " |", "|" + "---|" * len(header),
                      *("| " + " | ".join(line) + " |" for line in lines)])


def text(table):
    header, lines = table
    plain = [[cell.replace("*", "") for cell in line] for line in [header, *lines]]
    widths = [max(len(line[column]) for line in plain) for column in range(len(header))]
    aligned = ["  ".join(cell.ljust(width) if column == 0 else cell.rjust(width)
                         for column, (cell, width) in enumerate(zip(line, widths))) for line in plain]
    return "\n".join([aligned[0], "-" * len(aligned[0]), *aligned[1:]])


def write_csv(path, results, facts):
    wanted = {(what, voxels or 0): target for _, what, sizes in targets.STAGES for voxels, target in sizes.items()}
    wanted |= {(what, targets.SLIDER_VOXELS): target for _, what, target in targets.SLIDERS}
    field = results.read_field_ms()
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["what", "soup", "voxels", "threads", "target_ms", "best_ms", "median_ms", "cpu_ms", "repetitions",
                         "x_read_field", "met", "peak_mb", "counters", "note", *FACTS])
        for row in results.rows:
            target = wanted.get((row.what, row.voxels)) if row.soup == "input" and not row.threads else None
            counters = " ".join(f"{key}={value:.10g}" for key, value in row.counters.items())
            numbers = ["" if value is None else f"{value:.4f}" for value in (row.best_ms, row.median_ms, row.cpu_ms)]
            multiple = f"{row.best_ms / field:.3f}" if field and row.best_ms is not None else ""
            writer.writerow([row.what, row.soup, row.voxels, row.threads, target or "", *numbers, row.repetitions, multiple,
                             verdict(row, target), "" if row.peak_mb is None else f"{row.peak_mb:.1f}", counters, row.note,
                             *(facts[key] for key in FACTS)])


def replace_between_markers(document, name, body):
    """Puts `body` between <!-- bench:name --> and <!-- /bench:name -->."""
    pattern = re.compile(rf"(<!-- bench:{name} -->\n).*?(<!-- /bench:{name} -->)", re.DOTALL)
    if not pattern.search(document):
        raise SystemExit(f"docs/PERFORMANCE.md has no markers for {name}")
    return pattern.sub(lambda found: found.group(1) + body + "\n" + found.group(2), document)
