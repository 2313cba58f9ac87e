/* The Model in the making: shared by the build_*.c files, private to them. */
#ifndef BILLOW_BUILDER_H
#define BILLOW_BUILDER_H

#include "elements/geometry.h"
#include "solver/build.h"
#include "solver/build_motion.h"
#include "solver/deck_index.h"
#include "solver/model.h"

/* One part with its laws resolved; in deck order. */
typedef struct PartRecord {
    int material, section; /* positions in Definitions, -1 if missing (reported) */
    LawKind law;
    ElementKind quad; /* kind of its quads */
    FabricLaw fabric;
    FibreAxis axis;
    double angle;                 /* BETA of the material and the section [rad] */
    double density, area_density; /* area_density: MAREA */
} PartRecord;

/* One shell, or one bare segment (part -1): node indices in deck order until build_renumber. */
typedef struct ShellRecord {
    int part, corner_count;
    int32_t node[4];
    ElementKind kind;
    LawKind law;
    double thickness, area, mass;
    FibreAxis axis;
    int source_count; /* pressures that act on it */
    int source[4];    /* pressure sources: airbags, then segment loads */
    int sign[4];      /* +1: the source is behind the stored winding (pushes along its normal) */
    int pressure_set; /* -1 none */
    int orientation;  /* of the area vector relative to the stored winding */
} ShellRecord;

typedef struct Builder {
    const Definitions *definitions;
    const BuildOptions *options;
    Diagnostics *diagnostics;
    Model *model;
    DeckIndex index;
    int node_count, shell_count, record_count; /* records: shells, then bare segments */
    size_t record_capacity;
    double *x;    /* (node_count x 3), deck order */
    double *mass; /* (node_count), deck order */
    ShellRecord *records;
    PartRecord *parts;
    Motion motion;
    SurfaceClosure *closures; /* (airbag count), nodes in deck order until build_renumber */
    int32_t *order;           /* element order: order[k] = record of the k-th element in group order */
} Builder;

/* A zeroed block that model_free releases; NULL without memory (reported as an environment error). */
void *builder_alloc(Builder *builder, size_t count, size_t size);
int builder_adopt(Builder *builder, void *block);

/* The stages, in order; 0, or -1 after reporting an error. Later stages need earlier ones to have succeeded. */
int build_parts(Builder *builder);                                   /* materials, sections -> laws */
int build_shells(Builder *builder);                                  /* shells -> records, masses */
int build_curves(Builder *builder);                                  /* and functions */
int build_functions(Builder *builder);                               /* by build_curves */
void renumber_functions(Builder *builder, const int32_t *new_index); /* by build_renumber */
int build_surfaces(Builder *builder);                                /* airbags' surfaces: orientation and caps */
int build_pressure_sets(Builder *builder); /* and segment loads -> pressure sets; after build_motion */
int build_airbags(Builder *builder);       /* gas models; after build_surfaces */
int build_jets(Builder *builder);          /* after build_groups */
void mark_jet_nodes(Builder *builder, unsigned char *special); /* by build_renumber: NREACT */
int build_sensors(Builder *builder);                           /* after the motion is taken over */
int build_output(Builder *builder);                            /* termination, step control, output plan */
int build_mass_scaling(Builder *builder);                      /* DT2MS */
int build_renumber(Builder *builder);                          /* node and element order for locality */
int build_groups(Builder *builder);                            /* blocks, kernel constants, corner lists */

#endif
