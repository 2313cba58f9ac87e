/* The Model: the deck validated, renumbered, oriented, closed and frozen. Built once (solver/build.h), never written
 * after. Node and element indices are internal, from 0; the user's ids are in node_id and element_id.
 *
 * Node order: [0, free_count) move by Newton's law alone (the lean loop); [free_count, moving_count) carry something
 * special (supports, prescribed motion, rigid bodies, hanging nodes, point loads, several pressures) and take the
 * general path; [moving_count, node_count) never move. */
#ifndef BILLOW_MODEL_H
#define BILLOW_MODEL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "airbag/connection.h"
#include "airbag/gas.h"
#include "airbag/jet.h"
#include "airbag/sensor.h"
#include "airbag/surface.h"
#include "contact/contact.h"
#include "contact/contact_entity.h"
#include "contact/rigid_wall.h"
#include "elements/damper.h"
#include "elements/erosion.h"
#include "elements/law.h"
#include "elements/link.h"
#include "solver/billow.h"
#include "solver/constraints.h"
#include "solver/curve.h"
#include "solver/diagnostics.h"
#include "solver/function.h"
#include "solver/implicit_elements.h"
#include "solver/loads.h"
#include "solver/point_mass.h"
#include "solver/relax_control.h"
#include "solver/rigid_body.h"
#include "solver/seam.h"
#include "solver/tie.h"

typedef enum ElementKind {
    ELEMENT_TRIANGLE,  /* 3-node, constant strain */
    ELEMENT_QUAD_FULL, /* 4-node, 2 x 2 points */
    ELEMENT_QUAD_ONE,  /* 4-node, one point and hourglass control */
} ElementKind;

/* What becomes of a reference geometry: LNRC, ISREFG and TSRFAC of *MAT_FABRIC (docs/theory.md, Reference geometry). */
typedef struct ReferenceRule {
    bool liner_waits;   /* no compression before the fabric is taut for the first time */
    bool keeps_tension; /* the initial tension is there from birth on */
    enum { RESTORE_NEVER, RESTORE_BY_CYCLE, RESTORE_BY_TIME } restore; /* of the initial tension */
    double factor; /* of RESTORE_BY_CYCLE, unless curve >= 0 gives it */
    int curve;     /* index into Model.curves, -1 none */
} ReferenceRule;

/* Elements of one part, kind, law, set of pressures and class of reference, stored in blocks of BILLOW_LANES as
 * structure of arrays. The last block is filled up with lanes of weight 0 on the last element's nodes. */
typedef struct ElementGroup {
    ElementKind kind;
    LawKind law; /* LAW_SURFACE: no stress, only volume and area vector (rigid, null, bare segments) */
    int part;    /* index into Model.parts; -1 for bare segments */
    int pressure_set;
    int corner_count, point_count;
    int element_count, block_count;
    int first_element;      /* index of its first element in Model.element arrays' group order, padded by blocks */
    int first_chunk;        /* index of its first chunk of BILLOW_CHUNK blocks in the reductions */
    const int32_t *node;    /* nodes (block_count x corner_count x LANES) */
    const int32_t *row;     /* rows of the corner sums, likewise */
    const double *geometry; /* kernel constants (block_count x geometry_size x LANES), layout in elements/membrane.h */
    int geometry_size;      /* doubles per lane */
    int history_size;       /* doubles per lane in State.history */
    size_t history_offset;  /* of block 0 in State.history [doubles] */
    FabricLaw material;     /* constants of the law */
    bool has_history;
    /* Reference geometry; geometry holds its constants. Where the mesh is the reference, all this is zero. */
    bool has_reference, rdt;
    double birth;                   /* [T]; up to it the constants are those of mesh_geometry */
    const double *mesh_geometry;    /* NULL if birth = 0 */
    const double *tension_geometry; /* with the initial tension in it (TSRFAC); NULL if it never comes back */
    const double *start_square;     /* smallest squared stretch of each element in the mesh (block_count x LANES) */
    ReferenceRule rule;
    const ErosionCriteria *erosion; /* NULL: nothing erodes */
} ElementGroup;

enum {
    BILLOW_CHUNK = 16,           /* blocks in one fixed partial sum */
    BILLOW_SEGMENT_CHUNKS = 4,   /* chunks in one segment at most: long ones have fewer rows */
    BILLOW_LEAST_SEGMENTS = 8,   /* of a model, where chunks allow it: so that threads get equal shares */
    BILLOW_CONTACT_SEGMENTS = 32 /* the same with contact, where elements without a law cost next to nothing */
};

/* A set of pressures that act together on a surface: net pressure = sum of sign * source pressure. */
typedef struct PressureSet {
    int count;
    int source[4]; /* index into pressure sources: airbags first, then segment loads */
    int sign[4];   /* +1: the source is on the inner side of the stored orientation */
    int push[4];   /* sign, or 0: the surface bounds the source's volume, but does not feel its pressure */
} PressureSet;

typedef struct Part {
    int id, deck_index;
    char title[BILLOW_TITLE_LENGTH];
    int material_id, section_id;
    int material_kind; /* MaterialKind */
    int rigid_body;    /* index into Model.rigid_bodies, -1 if deformable */
    int element_count;
    double mass;         /* of its elements [M] */
    double point_mass;   /* on nodes, that count for it [M] */
    double area;         /* initial [L2] */
    int reference_count; /* elements with a reference geometry: area and mass by it, and by the mesh */
    double reference_area, reference_mass, referred_area, referred_mass;
    double density, thickness;
} Part;

/* A solid of a rigid part: a share of its mass at each corner. */
typedef struct Solid {
    int part;
    int32_t node[8];
    double share[8]; /* [M] */
} Solid;
enum { BILLOW_BAG_FUNCTIONS = 8 };

/* One control volume. */
typedef struct Airbag {
    int id; /* the user's, or counted from 1 in deck order */
    char heading[BILLOW_TITLE_LENGTH];
    GasModel gas;            /* airbag/gas.h */
    double vsca, psca, vini; /* V_gas = VSCA V - VINI, p_applied = PSCA p */
    double mwd, spsf;
    SurfaceClosure closure; /* caps and report, airbag/surface.h */
    int *part;              /* indices of the parts on its surface (part_count) */
    int part_count;
    int surface_parts; /* the rest of part are vents off the surface */
    int first_part;    /* place of part[0] in State.part_area */
    int *node;         /* nodes on its surface (node_count), ascending */
    int node_count;
    int erodible_count;     /* facets of its surface that may erode */
    int32_t *erodible_node; /* (erodible_count x 4), wound outwards */
    int64_t *erodible_slot; /* their padded element indices (erodible_count) */
    int pop_part;           /* RBIDP: index of the part whose acceleration may open the exits, -1 none */
    int facet_count;        /* FLUID_AND_GAS only: its surface, wound outwards (facet_count x 4) */
    int32_t *facet;
    int function[BILLOW_BAG_FUNCTIONS]; /* indices of the functions that the gas uses (function_count) */
    int function_count;
    double ambient; /* pressure outside: applied pressure = p - ambient */
    bool idle;      /* of the phase before the run, which ignores it: LCMT has SIDR = 0 */
    Source source;
} Airbag;

/* Output schedule from the *DATABASE cards; an interval of 0 means none. */
typedef struct OutputPlan {
    double states; /* VTKHDF and XDMF */
    double glstat, abstat, nodout, rbdout, rcforc, rwforc, gceout, matsum;
    double restart;    /* checkpoint interval, 0: only at the end or on signal */
    int *history_node; /* nodes of nodout (history_count) */
    int history_count;
} OutputPlan;

typedef struct Model {
    char title[BILLOW_TITLE_LENGTH];

    int node_count, free_count, moving_count;
    int *node_id;           /* user's ids (node_count) */
    int *deck_node;         /* internal index of the deck's i-th node (node_count) */
    double *initial;        /* initial position (node_count x 3) [L] */
    double *velocity;       /* initial velocity (node_count x 3) [L/T]; NULL: at rest */
    double *mass;           /* lumped, mass scaling included (node_count) [M] */
    double *inverse_mass;   /* (node_count); 0 for massless nodes */
    int32_t *node_pressure; /* pressure set of nodes in the lean loop (node_count); pressure_set_count: none */
    int32_t *node_class;    /* body-force and damping class (node_count); NULL if the scene has none */

    int element_count; /* shells in deck order, rigid ones included; bare segments are not counted */
    int deformable_count;
    int *element_id, *element_part;
    int32_t *element_node;     /* (element_count x 4); triangles repeat the third */
    int64_t *element_slot;     /* padded element index: group g, block b, lane l -> g.first_element + b LANES + l */
    double *element_thickness; /* (element_count) [L] */
    double *element_mass;      /* (element_count) [M] */
    bool has_reference;        /* some group has a reference geometry */
    bool has_accounts;         /* some group's stress may feed the motion: State.account is there */
    bool has_erosion;          /* some group has criteria: State.eroded is there */
    bool eroded_nodes_stay;    /* ENMASS = 2: in contact, nodes whose shells are all gone */
    bool liner_waits;          /* of some group: State.reached is there */

    int solid_count;
    Solid *solids;
    int point_mass_count;
    PointMass *point_masses; /* solver/point_mass.h; mass has them in it */
    int link_count;
    Link *links; /* springs, cables, trusses: elements/link.h */
    int damper_count;
    Damper *dampers; /* elements/damper.h */
    int seam_count;
    Seam *seams;   /* solver/seam.h */
    TieTable ties; /* solver/tie.h */

    int group_count, chunk_count, padded_count;
    ElementGroup *groups;
    size_t history_size; /* doubles */

    /* Segments: runs of chunks of one group, each worked on by one thread. A node has a row of corner sums in every
     * segment that touches it; the rows of a segment follow each other. */
    int segment_count, row_count;
    int32_t *segment_chunk;  /* first chunk of each segment (segment_count + 1) */
    int32_t *row_start;      /* first row of each segment (segment_count + 1) */
    int32_t *segment_order;  /* segments by the place of their nodes, as threads share them out (segment_count) */
    int32_t *row_set;        /* pressure set of each row, -1: none (row_count) */
    int32_t *node_row_start; /* CSR: rows of node n are node_row[node_row_start[n] .. node_row_start[n + 1]) */
    int32_t *node_row;       /* in the order of the segments (row_count) */

    double origin[3]; /* point about which volumes are summed [L] */
    int pressure_set_count;
    PressureSet *pressure_sets;

    int part_count;
    Part *parts;
    int airbag_count;
    Airbag *airbags;
    int connection_count;
    GasConnection *connections; /* airbag/connection.h */
    int bag_part_count;         /* parts of all bags together */
    int *group_place; /* place of each group in each bag's list of parts, -1 none (group_count x airbag_count) */
    bool has_fluid;   /* a bag of FLUID_AND_GAS: pressure by height */
    bool blockage;    /* contact blocks leaking fabric, vents or openings: State.contact_share is there */
    int sensor_count;
    Sensor *sensors;      /* airbag/sensor.h (sensor_count) */
    int *sensor_airbag;   /* index of the airbag that each starts (sensor_count) */
    void *sensor_library; /* handle of dlopen, NULL none */
    int jet_count, jet_facet_count, jet_row_count;
    Jet *jets; /* airbag/jet.h (jet_count); their facets: jet_facet_count, their rows: jet_row_count */
    int curve_count;
    Curve
        *curves; /* (first_function + function_count): after room for splines one of a single point for each function */
    int first_function; /* index of the first function's curve, >= curve_count */
    int function_count;
    FunctionProgram *functions; /* solver/function.h, set as curves in solver/step_functions.c */
    int segment_load_count;
    SegmentLoad *segment_loads; /* solver/loads.h */
    Loads loads;                /* node loads, body classes: solver/loads.h */
    Constraints constraints;    /* supports, prescribed motion, hanging nodes: solver/constraints.h */
    int rigid_body_count;
    RigidBody *rigid_bodies; /* moving ones, solver/rigid_body.h */
    int wall_count;
    RigidWall *walls;       /* contact/rigid_wall.h */
    bool walls_block;       /* nodes on rigid walls count as covered */
    bool walls_push_bodies; /* some wall acts on moving rigid bodies (RWPNAL) */
    bool has_moving_walls;  /* some wall has a mass: the nodes' momentum moves it */
    int contact_count;
    ContactInterface *contacts; /* contact/contact.h */
    int contact_row;            /* first of node_count rows with the contact forces, one more row of each node */
    double *contact_inverse;    /* inverse mass that contact feels of each node (node_count); NULL without contact */
    int entity_count;
    ContactEntity *entities;    /* contact/contact_entity.h */
    size_t entity_probe_count;  /* of all entities together */
    size_t contact_memory_size; /* entries of State.contact_memory */

    ImplicitElements implicit;

    double end_time, step_scale, step_initial, step_minimum; /* ENDTIM, TSSFAC, DTINIT, DTMIN */
    bool caps_push_rim;                                      /* hole caps give their pressure force to their rim */
    int end_cycle;
    int step_limit_curve;      /* index into curves, -1 none (TSLIMT's LCTM) */
    double added_mass;         /* by DT2MS [M] */
    double energy_error_limit; /* the run stops beyond this share, 0.1 by default */
    OutputPlan output;
    RelaxControl relax; /* the phase before the run */

    void **owned; /* blocks released by model_free */
    size_t owned_count, owned_capacity;
} Model;

/* Anything that pushes by the rows of contact: contacts or entities. */
static inline bool model_has_contact(const Model *m)
{
    return m->contact_count > 0 || m->entity_count > 0;
}

void model_free(Model *model);

#endif
