/* Scenes: meshes and LS-DYNA keyword decks made by program, shared by tests, benchmarks and examples.
 *
 * A SceneMesh is built from pieces (disc, grid, sphere, box ...), changed as a whole (weld, affine map, sewn copy) and
 * written by the scene_write functions into a SceneText, card by card. Node and shell ids in the deck are the index
 * + 1. Out of memory sets the failed flag; nothing else is then added, and callers check it once at the end. */
#ifndef BILLOW_SCENE_H
#define BILLOW_SCENE_H

#include <stdbool.h>
#include <stddef.h>

/* ---- mesh ---------------------------------------------------------------------------------------------------- */

typedef struct SceneMesh {
    int node_count, shell_count;
    double *x;       /* positions (node_count x 3) [L] */
    int (*shell)[4]; /* node indices (shell_count); triangles repeat the third */
    int *part;       /* user's part id of each shell (shell_count) */
    size_t node_capacity, part_capacity, shell_capacity;
    bool failed; /* memory ran out */
} SceneMesh;

/* How a piece is divided. Spheres know only quads and triangles (any other pattern). */
typedef enum ScenePattern {
    SCENE_QUADS,
    SCENE_DIAGONAL, /* two triangles, diagonals along (+1, +1): "d1" where the centre is the first corner */
    SCENE_ACROSS,   /* two triangles, diagonals along (+1, -1): "d2" */
    SCENE_CROSS     /* four triangles about the middle of each square */
} ScenePattern;

void scene_mesh_free(SceneMesh *mesh);

/* Adds one node; returns its index. */
int scene_add_node(SceneMesh *mesh, double x, double y, double z);

/* Adds one shell; a triangle is given with d = c. */
void scene_add_shell(SceneMesh *mesh, int part, int a, int b, int c, int d);

/* A point of a unit square mapped into space: x from s, t in [0, 1]. */
typedef void SceneMap(const void *user, double s, double t, double x[3]);

/* Grid of nx x ny squares on the map; normal towards dx/ds x dx/dt. Nodes are not shared with earlier pieces. */
void scene_add_grid(SceneMesh *mesh, int part, ScenePattern pattern, int nx, int ny, SceneMap *map, const void *user);

/* The rectangle lx x ly in the plane z = 0 with its first corner at the origin, normal +z. */
void scene_add_rectangle(SceneMesh *mesh, int part, ScenePattern pattern, int nx, int ny, double lx, double ly);

/* Disc about the origin in the plane z = 0, normal +z. SCENE_DIAGONAL: n rings of 6 i nodes about the centre (node
 * first), 6 n^2 triangles. Other patterns: an O-grid of 5 blocks, n cells from centre to rim, about 3 n^2 squares, each
 * divided by the pattern. Nodes welded. */
void scene_add_disc(SceneMesh *mesh, int part, ScenePattern pattern, int n, double radius);

/* Ring inner < r < outer in the plane z = 0, normal +z: nr x nt squares, closed. */
void scene_add_ring(SceneMesh *mesh, int part, ScenePattern pattern, int nr, int nt, double inner, double outer);

/* Sphere about the origin, outward normals. Triangles: icosahedron of frequency n, 20 n^2; quads: cube of 6 n^2. */
void scene_add_sphere(SceneMesh *mesh, int part, ScenePattern pattern, int n, double radius);

/* Torus about z, outward normals: circle of radius minor about the circle of radius major. */
void scene_add_torus(SceneMesh *mesh, int part, ScenePattern pattern, int n_minor, int n_major, double major,
                     double minor);

/* Open tube about z from z = 0 to length, outward normals. */
void scene_add_tube(SceneMesh *mesh, int part, ScenePattern pattern, int nz, int nt, double radius, double length);

/* Box [0, a] x [0, b] x [0, c] of single quads, outward normals: bottom, lid and four walls as parts of their own. The
 * four bottom nodes come first, then the four of the lid. */
void scene_add_box(SceneMesh *mesh, int bottom, int lid, int wall, double a, double b, double c);

/* Merges nodes closer than tolerance among those from first on; the first of each cluster stays. */
void scene_weld(SceneMesh *mesh, int first, double tolerance);

/* True for nodes that a function shall act on. */
typedef bool SceneSelect(const void *user, const double x[3]);

/* Doubles all shells: the copy has the given part id and reversed winding and shares the selected nodes (a seam). */
void scene_sew_copy(SceneMesh *mesh, int part, SceneSelect *shared, const void *user);

/* x <- matrix x + shift for all nodes from first on (matrix 3 x 3 row-major). */
void scene_transform(SceneMesh *mesh, int first, const double matrix[9], const double shift[3]);

/* Reverses the winding of the shells [first, end). */
void scene_reverse(SceneMesh *mesh, int first, int end);

/* Gives shells whose centre is selected another part id; returns how many. */
int scene_retag(SceneMesh *mesh, int from, int to, SceneSelect *select, const void *user);

/* Removes the shells of a part; nodes without any shell are removed too. */
void scene_drop_part(SceneMesh *mesh, int part);

/* Ready-made selections: user points to the value. */
bool scene_select_all(const void *user, const double x[3]);
bool scene_select_radius(const void *radius, const double x[3]); /* distance from the z axis, to 1e-9 of it */
bool scene_select_plane(const void *plane, const double x[3]);   /* ScenePlane */

typedef struct ScenePlane {
    int axis;     /* 0, 1, 2 */
    double value; /* coordinate on the axis */
    double tolerance;
} ScenePlane;

/* ---- deck text ------------------------------------------------------------------------------------------------ */

typedef struct SceneText {
    char *text; /* zero-terminated */
    size_t length, capacity;
    bool exact; /* nodes in free format with all digits; else in the classic 8/16 columns */
    bool failed;
} SceneText;

void scene_text_free(SceneText *deck);

/* Adds text in printf form. */
void scene_print(SceneText *deck, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds one card of numbers: in 10-column fields if all are exact in nine characters, else in free format with the
 * shortest digits that read back to the same number. Whole numbers are written without a point. */
void scene_card(SceneText *deck, int count, const double *fields);
#define SCENE_CARD(deck, ...)                                                                                          \
    scene_card((deck), (int)(sizeof((double[]){__VA_ARGS__}) / sizeof(double)), (double[]){__VA_ARGS__})

/* *KEYWORD, *TITLE, *CONTROL_TERMINATION, *CONTROL_TIMESTEP (tssfac 0: the deck's default). */
void scene_begin(SceneText *deck, const char *title, double end_time, double tssfac);

/* The lines of nodes under *NODE or a reference geometry. */
void scene_write_nodes(SceneText *deck, const SceneMesh *mesh);

/* *NODE and *ELEMENT_SHELL of the whole mesh, and *END. The last thing to write. */
void scene_end(SceneText *deck, const SceneMesh *mesh);

/* Output intervals: glstat, abstat and states; 0 leaves the keyword out. */
void scene_write_output(SceneText *deck, double glstat, double abstat, double states);

void scene_write_part(SceneText *deck, int part, int section, int material, const char *title);
void scene_write_section(SceneText *deck, int section, int elform, double thickness);

/* A fabric. Zero-initialised members mean the card's default. */
typedef struct SceneFabric {
    int form;
    bool cse;
    double density, ea, eb, gab, prba, prab;
    double el, prl, lratio, damp;
    int aopt;              /* 0: edge n1-n2; 2: along the vector */
    double vector[3];      /* for aopt = 2 */
    double beta;           /* degrees */
    bool elastic;          /* MAT_ELASTIC of E = ea, nu = prba instead */
    double tension_factor; /* TSRFAC */
} SceneFabric;

/* Isotropic fabric. */
SceneFabric scene_isotropic(int form, bool cse, double density, double e, double nu);

void scene_write_fabric(SceneText *deck, int material, const SceneFabric *fabric);
void scene_write_elastic(SceneText *deck, int material, double density, double e, double nu);
void scene_write_null(SceneText *deck, int material, double density);

/* *MAT_RIGID with CMO = 1. con1, con2: 0 free ... 7 all fixed. */
void scene_write_rigid(SceneText *deck, int material, double density, int con1, int con2);

/* *DEFINE_CURVE: count pairs (x, y). */
void scene_write_curve(SceneText *deck, int curve, int count, const double *pairs);

/* y rises from 0 at time 0 to value at rise and stays; a rise of 0 is a step. */
void scene_write_ramp(SceneText *deck, int curve, double rise, double value);

/* *SET_NODE_LIST of the selected nodes; returns how many. */
int scene_write_node_set(SceneText *deck, int set, const SceneMesh *mesh, SceneSelect *select, const void *user);

/* *BOUNDARY_SPC_SET; dof flags for x, y, z. */
void scene_write_spc(SceneText *deck, int set, bool x, bool y, bool z);

/* *SET_PART_LIST of up to 8 parts. */
void scene_write_part_set(SceneText *deck, int set, int count, const int *parts);

/* *SET_SEGMENT of all shells of a part (0: all), and *LOAD_SEGMENT_SET: pressure towards the normals of curve times
 * scale (LS-DYNA's positive pressure acts against them). The set has the id set. */
void scene_write_pressure(SceneText *deck, int set, const SceneMesh *mesh, int part, int curve, double scale);

/* *DAMPING_GLOBAL with a constant (curve 0) or the factor of a curve. */
void scene_write_damping(SceneText *deck, int curve, double value);

/* *BOUNDARY_PRESCRIBED_MOTION_NODE: dof 1..3, vad 0 velocity, 1 acceleration, 2 displacement. */
void scene_write_motion(SceneText *deck, int node, int dof, int vad, int curve, double scale);

/* *BOUNDARY_PRESCRIBED_MOTION_RIGID. */
void scene_write_rigid_motion(SceneText *deck, int part, int dof, int vad, int curve, double scale);

/* *LOAD_BODY_Z: gravity g along -z. The curve must exist (constant 1). */
void scene_write_gravity(SceneText *deck, int curve, double g);

/* An ideal gas by its ratio of heat capacities and molar mass (R = 8.314462618 J/mol/K). */
typedef struct SceneGas {
    double gamma, molar_mass;
    double pressure, temperature; /* ambient, and of the bag at the start */
    double inflow_temperature;    /* 0: none */
    int inflow_curve;             /* mass flow, 0: none */
    double vent_coefficient, vent_area;
    int vent_curve;             /* area over absolute pressure, WANG_NEFSKE only; 0: vent_area */
    double vini;                /* VINI of card 1 */
    double overpressure;        /* POVER, WANG_NEFSKE only */
    double pop_pressure;        /* PPOP, WANG_NEFSKE only */
    double initial_temperature; /* IABT, WANG_NEFSKE only; 0: from PE and RO */
} SceneGas;

double scene_gas_constant(const SceneGas *gas); /* R/M [energy/mass/temperature] */
SceneGas scene_air(double pressure, double temperature);

/* *AIRBAG_SIMPLE_AIRBAG_MODEL and *AIRBAG_WANG_NEFSKE on a part set. */
void scene_write_simple_airbag(SceneText *deck, int part_set, const SceneGas *gas);
void scene_write_wang_nefske(SceneText *deck, int part_set, const SceneGas *gas);

/* ---- whole scenes ---------------------------------------------------------------------------------------------- */

/* A whole deck with its mesh. */
typedef struct Scene {
    SceneText deck;
    SceneMesh mesh;
} Scene;

void scene_free(Scene *scene);
bool scene_ok(const Scene *scene);

/* A static membrane under pressure, run to rest with mass damping. */
typedef struct SceneStatic {
    ScenePattern pattern;
    int elform; /* 9, or 5 */
    int n;      /* cells per radius or per half side */
    SceneFabric fabric;
    double thickness, pressure;
    double rise, end; /* pressure ramp and end of the run [T] */
    double damping;   /* *DAMPING_GLOBAL [1/T] */
    double size;      /* radius, or half side of the square */
} SceneStatic;

/* Clamped disc: rim fixed, pressure from below (Hencky). */
void scene_static_disc(Scene *scene, const SceneStatic *setup);

/* Upper half of a bag of two discs: rim stays in its plane (mylar balloon, circular driver bag). */
void scene_static_bag(Scene *scene, const SceneStatic *setup);

/* Upper half of a quarter of the square cushion, half side size: symmetry planes x = 0 and y = 0. */
void scene_static_square(Scene *scene, const SceneStatic *setup);

/* The examples. n sets the fineness; 0 means the example's own. */
void scene_driver_bag(Scene *scene, int n);
void scene_cushion(Scene *scene, int n);
void scene_landing_pad(Scene *scene, int n);
void scene_prestressed_cushion(Scene *scene, int n);
void scene_sewn_bag(Scene *scene, int n);

typedef enum SceneStriker {
    SCENE_BOX,             /* of a head's size, six shells */
    SCENE_FACETED_SPHERE,  /* the faces of 6 facets^2 shells */
    SCENE_SPHERE,          /* the same shells, but a smooth sphere meets the cushion */
    SCENE_CAPSULE,         /* two spheres and a tube between them meet it */
    SCENE_CAPSULE_PROFILE, /* the same by one body of revolution of many edges */
    SCENE_BOX_MESH,        /* the box as a convex mesh that nodes meet */
} SceneStriker;

/* A cushion of n x n squares a side (n = 0: 24) that is blown up on the floor; a rigid sphere, box or capsule drops on
 * it (part 3). The bag vents when it is pressed. facets of a sphere: 0 for 6. */
void scene_impactor(Scene *scene, int n, SceneStriker striker, int facets);

/* A square bag of 2 n^2 quadrilaterals or 4 n^2 triangles (n a multiple of 4; 0: 72; of patterns SCENE_QUADS or
 * SCENE_DIAGONAL) folded in eight layers, gap apart (0: their thickness), that unfolds against itself. */
void scene_folded_bag(Scene *scene, ScenePattern pattern, int n, double gap);

/* The same square of fabric FORM 2, folded or from flat and then without contact, brought to rest at 0.1 s by mass
 * damping; a relief valve closes at 115 kPa. Both have the flat square as their cloth. */
void scene_resting_bag(Scene *scene, int n, bool folded);

/* A bag of two discs in the plane z = 0, parts 1 (upper) and 2 (lower), whose fabric gives the tension of a folded mesh
 * back; blown up by an inflator, or with pressure > 0 by this constant pressure, and damped until it rests. The bag as
 * a whole; or its mesh, and its deck up to nodes and shells, for callers that fold it in between. */
void scene_folding_bag(Scene *scene, int n, double pressure);
void scene_folding_mesh(SceneMesh *mesh, int n);
void scene_folding_deck(Scene *scene, double pressure);

/* The bag of scene_folding_bag with vents and contact with itself, the middle of its lower panel held, under a wall. */
void scene_wall_bag(Scene *scene, int n);

/* The speed benchmark: gas-filled cushion of about the given number of shells, orthotropic fabric FORM 0 with CSE. The
 * run takes about the given number of cycles. */
void scene_speed(Scene *scene, ScenePattern pattern, int shells, int cycles);

#endif
