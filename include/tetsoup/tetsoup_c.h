/* tetsoup for C, and for every language that can call C: the WebAssembly module exports exactly these functions.
 *
 * Handles are opaque. Whatever a handle was made from may be destroyed before it; NULL may be destroyed. One handle is
 * used by one thread at a time.
 *
 * Functions that can fail return a status and give their results through their last arguments, which they leave alone
 * when they fail; tetsoup_last_error() says what was wrong. No exception leaves these functions.
 *
 * Views point into a handle: `count` rows of `width` numbers each. They hold until the handle is changed (run, stepped,
 * given something) or destroyed; slices and qualities only until the next of their kind. Where a simulation's views
 * hold longer, it says so. Texts are UTF-8, end with a zero, and hold until the next call on the same thread that gives
 * a text.
 *
 * Options are JSON texts with the keys of scene files (docs/SCENES.md); NULL stands for "{}", and what is left out is
 * as by default. Lengths, directions and signs are as in tetsoup/types.h: tets are positive, boundary triangles
 * counter-clockwise from outside. */
#ifndef TETSOUP_TETSOUP_C_H
#define TETSOUP_TETSOUP_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Changes when a function changes or goes; new ones may come without. */
#define TETSOUP_C_VERSION 1

typedef enum tetsoup_status {
  TETSOUP_OK = 0,
  TETSOUP_INVALID_INPUT = 1, /* The caller is wrong; the text names the argument, or the key of the JSON. */
  TETSOUP_IO_ERROR = 2,      /* A file is not what it says, or cannot be written; the text names it. */
  TETSOUP_CANCELLED = 3,     /* The progress callback said stop. */
  TETSOUP_OUT_OF_MEMORY = 4,
  TETSOUP_INTERNAL_ERROR = 5 /* We are wrong. */
} tetsoup_status;

typedef struct tetsoup_soup tetsoup_soup;
typedef struct tetsoup_pipeline tetsoup_pipeline;
typedef struct tetsoup_model tetsoup_model;
typedef struct tetsoup_simulation tetsoup_simulation;

typedef struct tetsoup_floats {
  const float* data;
  size_t count; /* Rows, */
  size_t width; /* and numbers in each. */
} tetsoup_floats;

typedef struct tetsoup_indices {
  const uint32_t* data;
  size_t count;
  size_t width;
} tetsoup_indices;

/* Called from the thread that called, every few milliseconds of work, with the done fraction in [0, 1]. Return 0 to
 * stop, anything else to go on. NULL wherever nobody watches. */
typedef int (*tetsoup_progress)(const char* stage, double fraction, void* context);

/* --- The library ------------------------------------------------------------------------------------------------ */

/* TETSOUP_C_VERSION of the library, to be compared with that of the header. */
int32_t tetsoup_c_version(void);
/* "0.1.0" */
const char* tetsoup_version(void);
/* What was wrong with the last call on this thread that failed; "" if none has. Holds until the next one that fails. */
const char* tetsoup_last_error(void);
/* Upper bound on threads from now on, 0: all cores. Results never depend on it. */
tetsoup_status tetsoup_set_thread_count(int32_t threads);
/* 1 in a build without threads. */
int32_t tetsoup_thread_count(void);

/* --- Soups ------------------------------------------------------------------------------------------------------ */

/* JSON: [{"name": "torus", "summary": "..."}, ...] */
tetsoup_status tetsoup_sample_list(const char** json);
/* `damage`: share of the triangles removed at random, [0, 1). */
tetsoup_status tetsoup_soup_sample(const char* name, double damage, uint32_t seed, tetsoup_soup** soup);
/* Bytes of an OBJ, STL, PLY, OFF, GLB, 3MF or Collada file; which, is told by content where that is certain, else by
 * the name's extension. Anything that parses is taken, NaN and wild indices too: they are counted in the report. */
tetsoup_status tetsoup_soup_parse(const void* bytes, size_t size, const char* name, tetsoup_soup** soup);
/* Any triangles: xyz of the vertices, three indices a triangle. */
tetsoup_status tetsoup_soup_create(const float* vertices, size_t vertex_count, const uint32_t* triangles,
                                   size_t triangle_count, tetsoup_soup** soup);
/* (N, 3) as in the file, and (T, 3): polygons are cut into fans. */
tetsoup_status tetsoup_soup_vertices(const tetsoup_soup* soup, tetsoup_floats* vertices);
tetsoup_status tetsoup_soup_triangles(const tetsoup_soup* soup, tetsoup_indices* triangles);
/* JSON: the diagnosis, with its "class": "closed", "open", "soup" or "empty". */
tetsoup_status tetsoup_soup_report(const tetsoup_soup* soup, const char** json);
void tetsoup_soup_destroy(tetsoup_soup* soup);

/* --- From soup to mesh ------------------------------------------------------------------------------------------ */

typedef enum tetsoup_stage {
  TETSOUP_STAGE_SOUP = 0,
  TETSOUP_STAGE_DISTANCE = 1,
  TETSOUP_STAGE_PSEUDO_VOLUME = 2,
  TETSOUP_STAGE_LATTICE = 3,
  TETSOUP_STAGE_SMOOTH = 4
} tetsoup_stage;

typedef enum tetsoup_mesh {
  TETSOUP_MESH_LATTICE = 0, /* As cut by density, before smoothing. */
  TETSOUP_MESH_FINAL = 1
} tetsoup_mesh;

typedef enum tetsoup_measure {
  TETSOUP_MEAN_RATIO = 0,  /* 1: regular, 0: flat or inverted. */
  TETSOUP_MIN_DIHEDRAL = 1 /* Smallest dihedral angle, degrees. */
} tetsoup_measure;

typedef enum tetsoup_field {
  TETSOUP_FIELD_DISTANCE = 0, /* In the soup's unit; infinite beyond the band that was needed. */
  TETSOUP_FIELD_VOTES = 1,    /* Rays that call the voxel inside, 0 to `rays`. */
  TETSOUP_FIELD_INSIDE = 2    /* 0 or 1. */
} tetsoup_field;

/* Where the voxels lie, padding included; x runs fastest. */
typedef struct tetsoup_grid {
  double origin[3]; /* Centre of voxel (0, 0, 0). */
  double voxel_size;
  double d_max; /* Largest distance in the soup's box. */
  double band;  /* (1 - k) d_max that the pseudo volume used; 0 before it. */
  int32_t size[3];
  int32_t pad;  /* Voxels added on each side of the soup's box. */
  int32_t rays; /* 26 or 13; 0 before the pseudo volume. */
} tetsoup_grid;

/* Cleans and diagnoses the soup. */
tetsoup_status tetsoup_pipeline_create(const tetsoup_soup* soup, tetsoup_progress progress, void* context,
                                       tetsoup_pipeline** pipeline);
/* Grids that need more bytes are refused before they are made, with a text that says how many voxels fit; 0: no limit,
 * as in the beginning. */
tetsoup_status tetsoup_pipeline_set_memory_limit(tetsoup_pipeline* pipeline, size_t bytes);
/* Brings the stages up to and including `last` up to date; what no changed option reaches stands. `options`: the keys
 * of a body's "mesh" in scene files, lengths in the soup's unit. After TETSOUP_CANCELLED finished stages are kept. */
tetsoup_status tetsoup_pipeline_run_until(tetsoup_pipeline* pipeline, tetsoup_stage last, const char* options,
                                          tetsoup_progress progress, void* context);
/* All stages. */
tetsoup_status tetsoup_pipeline_run(tetsoup_pipeline* pipeline, const char* options, tetsoup_progress progress,
                                    void* context);

/* All stages with the fewest of 500, 1,000, 2,000 ... 32,000 tets at which the shape holds; `held` is 0 where none of
 * these does, and the mesh then that of most. Both may be NULL. `options`: as above, without a number or size of tets.
 */
tetsoup_status tetsoup_pipeline_find_tets(tetsoup_pipeline* pipeline, const char* options, tetsoup_progress progress,
                                          void* context, size_t* tets, int32_t* held);

/* Results of stages that are up to date; TETSOUP_INVALID_INPUT where one is not.
 * (V, 3), (T, 4), the boundary (B, 3), and (T, 1). */
tetsoup_status tetsoup_pipeline_vertices(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_floats* vertices);
tetsoup_status tetsoup_pipeline_tets(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* tets);
tetsoup_status tetsoup_pipeline_boundary(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* triangles);
/* Those of the boundary that bound a closed space in the mesh's midst, for pressure; (B, 3), none without such a space.
 */
tetsoup_status tetsoup_pipeline_cavities(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_indices* triangles);
tetsoup_status tetsoup_pipeline_tet_quality(tetsoup_pipeline* pipeline, tetsoup_mesh mesh, tetsoup_measure measure,
                                            tetsoup_floats* values);
/* The grid, once the distance is there. */
tetsoup_status tetsoup_pipeline_grid(const tetsoup_pipeline* pipeline, tetsoup_grid* grid);
/* One layer of voxels across an axis (0, 1, 2: x, y, z): `count` rows of `width` voxels. Across x the voxels of a row
 * follow each other along y, and the rows along z; across y along x and z; across z along x and y. */
tetsoup_status tetsoup_pipeline_slice(tetsoup_pipeline* pipeline, tetsoup_field field, int32_t axis, int32_t layer,
                                      tetsoup_floats* values);
/* JSON of all that is up to date: "soup", "grid", "pseudo_volume", "lattice", "smooth", "lattice_quality", "quality"
 * (with its histogram), "fidelity" (to the soup), "readiness" for `material` (keys as in scene files), "notes"
 * (sentences for the user), "seconds", "options". Members are those of `tetsoup mesh --json`. */
tetsoup_status tetsoup_pipeline_report(tetsoup_pipeline* pipeline, const char* material, const char** json);
/* JSON: "iou_pseudo_volume" and "boundary_distance_edges" of the final mesh; takes longer than the report. */
tetsoup_status tetsoup_pipeline_accuracy(tetsoup_pipeline* pipeline, const char** json);
void tetsoup_pipeline_destroy(tetsoup_pipeline* pipeline);

/* --- The mesh with the surface that hangs on it ----------------------------------------------------------------- */

/* Copies the final mesh and hangs the input's own vertices on it. `name`: of the body, in files; not empty. */
tetsoup_status tetsoup_model_create(const tetsoup_pipeline* pipeline, const char* name, tetsoup_progress progress,
                                    void* context, tetsoup_model** model);
/* kg/m^3, Pa, [0, 0.5), and the length of the mesh's unit in metres. */
tetsoup_status tetsoup_model_set_material(tetsoup_model* model, double density, double young, double poisson,
                                          double metres_per_unit);
/* Which way is up for the scenes of engines: 0, 1, 2: x, y, z (as by default). */
tetsoup_status tetsoup_model_set_up(tetsoup_model* model, int32_t axis);
/* Holds the vertices in a box, by a name in files; `count` of them, which may be NULL. */
tetsoup_status tetsoup_model_add_pins(tetsoup_model* model, const char* name, const double low[3], const double high[3],
                                      size_t* count);
/* Multiplies stiffness and density of each tet so that the mesh moves like one of 40,000 tets; files hold what they
 * have a place for. `pipeline`: that the model is of; for the Poisson ratio of the material that was set, else .35.
 * JSON, which may be NULL: "calibration" of `tetsoup mesh --json`, without files. */
tetsoup_status tetsoup_model_calibrate(tetsoup_model* model, const tetsoup_pipeline* pipeline,
                                       tetsoup_progress progress, void* context, const char** json);
tetsoup_status tetsoup_model_vertices(const tetsoup_model* model, tetsoup_floats* vertices);
tetsoup_status tetsoup_model_tets(const tetsoup_model* model, tetsoup_indices* tets);
/* The surface at rest: (N, 3) and (T, 3), those of the soup. */
tetsoup_status tetsoup_model_surface(const tetsoup_model* model, tetsoup_floats* vertices, tetsoup_indices* triangles);
/* The surface after the mesh's vertices have moved to `positions`, xyz each, and its unit normals, smooth across
 * vertices that triangles share. Either view may be NULL. */
tetsoup_status tetsoup_model_deform(tetsoup_model* model, const float* positions, size_t vertex_count,
                                    tetsoup_floats* vertices, tetsoup_floats* normals);
/* JSON: "embedding", "pins". */
tetsoup_status tetsoup_model_report(const tetsoup_model* model, const char** json);

/* JSON: [{"name": "msh", "summary": "...", "extension": ".msh"}, ...] */
tetsoup_status tetsoup_format_list(const char** json);
/* JSON: [{"name": "mujoco", "title": "MuJoCo", "summary": "...", "extension": "...", "usage": "..."}, ...]; in the
 * usage {mesh}, {stem} and {scene} stand for names of files. */
tetsoup_status tetsoup_engine_list(const char** json);
/* Writes files; `format` by its name in the list, or NULL: by the path's extension. JSON: the files' paths. */
tetsoup_status tetsoup_model_write(const tetsoup_model* model, const char* path, const char* format, const char** json);
/* Writes what an engine wants, with a scene beside it. The scene is stiff enough not to sag unless a material was set.
 * JSON: {"files": [...], "usage": "what to do next"} */
tetsoup_status tetsoup_model_write_for_engine(const tetsoup_model* model, const char* path, const char* engine,
                                              const char** json);
void tetsoup_model_destroy(tetsoup_model* model);

/* --- Simulation ------------------------------------------------------------------------------------------------- */

/* `options`: "gravity", "solver", "substeps", "max_substeps", "contact_interval", "contacts", "potentials" of scene
 * files. Metres, kilograms, seconds. */
tetsoup_status tetsoup_simulation_create(const char* options, tetsoup_simulation** simulation);
/* `material` and `place`: the keys of a body's "material" and "place" in scene files; "scale" there brings the model to
 * metres. `body` is its number: 0, 1, 2, ... Its surface hangs on it. */
tetsoup_status tetsoup_simulation_add_model(tetsoup_simulation* simulation, const tetsoup_model* model,
                                            const char* material, const char* place, size_t* body);
/* The same for any tets, without a surface. */
tetsoup_status tetsoup_simulation_add_mesh(tetsoup_simulation* simulation, const float* vertices, size_t vertex_count,
                                           const uint32_t* tets, size_t tet_count, const char* material,
                                           const char* place, size_t* body);
/* Keeps bodies where dot(normal, p) >= offset. */
tetsoup_status tetsoup_simulation_add_plane(tetsoup_simulation* simulation, const double normal[3], double offset,
                                            double friction);
/* Keeps bodies out of the pseudo volume of a soup whose unit is a metre, on a grid of so many voxels. */
tetsoup_status tetsoup_simulation_add_obstacle(tetsoup_simulation* simulation, const tetsoup_soup* soup, int32_t voxels,
                                               double friction, tetsoup_progress progress, void* context);
tetsoup_status tetsoup_simulation_pin(tetsoup_simulation* simulation, size_t body, uint32_t vertex);
tetsoup_status tetsoup_simulation_unpin(tetsoup_simulation* simulation, size_t body, uint32_t vertex);
/* Pulls a vertex to a point, with so many N/m: what a mouse does. */
tetsoup_status tetsoup_simulation_add_spring(tetsoup_simulation* simulation, size_t body, uint32_t vertex,
                                             const double target[3], double stiffness, size_t* spring);
tetsoup_status tetsoup_simulation_move_spring(tetsoup_simulation* simulation, size_t spring, const double target[3]);
tetsoup_status tetsoup_simulation_remove_spring(tetsoup_simulation* simulation, size_t spring);
/* Advances time by (0, 1] seconds. Of a scene whose pins move by hand, tetsoup_scene_advance() moves them too. */
tetsoup_status tetsoup_simulation_step(tetsoup_simulation* simulation, double seconds);

tetsoup_status tetsoup_simulation_body_count(const tetsoup_simulation* simulation, size_t* count);
/* (V, 3); both views hold as long as the simulation, and show every step. */
tetsoup_status tetsoup_simulation_positions(const tetsoup_simulation* simulation, size_t body,
                                            tetsoup_floats* positions);
tetsoup_status tetsoup_simulation_velocities(const tetsoup_simulation* simulation, size_t body,
                                             tetsoup_floats* velocities);
/* Puts a body elsewhere: as many vertices as it has, xyz each; velocities are kept. */
tetsoup_status tetsoup_simulation_set_positions(tetsoup_simulation* simulation, size_t body, const float* positions,
                                                size_t vertex_count);
tetsoup_status tetsoup_simulation_set_velocities(tetsoup_simulation* simulation, size_t body, const float* velocities,
                                                 size_t vertex_count);
/* The tets of a body's mesh, and the triangles of its surface: both never change. Without a surface it is the mesh's
 * boundary. */
tetsoup_status tetsoup_simulation_tets(tetsoup_simulation* simulation, size_t body, tetsoup_indices* tets);
tetsoup_status tetsoup_simulation_triangles(tetsoup_simulation* simulation, size_t body, tetsoup_indices* triangles);
/* Vertices of the surface as the body is now, and its unit normals; either may be NULL. Each body has its own views,
 * which hold until the surface of the same body is asked for again. Without a surface they are the mesh's vertices, and
 * there are no normals: count 0. */
tetsoup_status tetsoup_simulation_surface(tetsoup_simulation* simulation, size_t body, tetsoup_floats* vertices,
                                          tetsoup_floats* normals);
/* Of all positions and velocities, to the bit: the same on every machine, and in the browser. */
tetsoup_status tetsoup_simulation_state_hash(const tetsoup_simulation* simulation, uint64_t* hash);
/* JSON: "time", "tet_count", "contacts", "touching", "substeps", "clamped", "left_out", "loose_vertices", "parts",
 * "energy", "bodies": [{"name", "vertex_count", "tet_count", "make"}]; bodies of equal "make" share tets and triangles.
 */
tetsoup_status tetsoup_simulation_report(const tetsoup_simulation* simulation, const char** json);
void tetsoup_simulation_destroy(tetsoup_simulation* simulation);

/* --- Scenes ----------------------------------------------------------------------------------------------------- */

/* JSON: [{"name": "robots-on-tree", "summary": "..."}, ...] */
tetsoup_status tetsoup_scene_list(const char** json);
/* A built-in scene as the JSON of a scene file, to be loaded as it is or changed. */
tetsoup_status tetsoup_scene_text(const char* name, const char** json);
/* Meshes all bodies of a scene file's text and puts them into a simulation. `folder`: where names of files in it begin;
 * NULL: the current one. */
tetsoup_status tetsoup_scene_load(const char* text, const char* folder, tetsoup_progress progress, void* context,
                                  tetsoup_simulation** simulation);
/* Simulates one frame of a loaded scene, 1 / fps seconds; pins that are moved by hand move. */
tetsoup_status tetsoup_scene_advance(tetsoup_simulation* simulation);
/* Where time stands in a loaded scene after so many frames: pins that are moved or let go by then are; what moves
 * freely stays where it is. For a scene that is loaded anew, as of another material, and given the places of the old
 * one. */
tetsoup_status tetsoup_scene_seek(tetsoup_simulation* simulation, size_t frame);
/* Obstacles of a loaded scene that are no planes: (N, 3) and (T, 3) where they stand. */
tetsoup_status tetsoup_scene_obstacle_count(const tetsoup_simulation* simulation, size_t* count);
tetsoup_status tetsoup_scene_obstacle(const tetsoup_simulation* simulation, size_t obstacle, tetsoup_floats* vertices,
                                      tetsoup_indices* triangles);

#ifdef __cplusplus
}
#endif

#endif /* TETSOUP_TETSOUP_C_H */
