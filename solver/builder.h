/* The Model in the making: shared by the build_*.c files, private to them. */
#ifndef BILLOW_BUILDER_H
#define BILLOW_BUILDER_H

#include "elements/geometry.h"
#include "solver/build.h"
#include "solver/build_motion.h"
#include "solver/deck_index.h"
#include "solver/model.h"

/* Which keyword a part's section is of, and so what its elements are. */
typedef enum SectionKind { SECTION_NONE, SECTION_SHELL, SECTION_SOLID, SECTION_BEAM, SECTION_DISCRETE } SectionKind;

/* One part with its laws resolved; in deck order. */
typedef struct PartRecord {
    int material,
        section; /* positions in Definitions (in the list of sections of the kind), -1 if missing (reported) */
    SectionKind kind;
    LawKind law;
    ElementKind quad; /* kind of its quads */
    FabricLaw fabric;
    FibreAxis axis;
    double angle;                   /* BETA of the material and the section [rad] */
    double density, area_density;   /* area_density: MAREA */
    bool has_reference;             /* its elements may have a reference geometry */
    double reference_birth;         /* RGBRTH, 0: the birth of the reference geometry's card */
    ReferenceRule reference_rule;   /* LNRC, ISREFG, TSRFAC */
    const ErosionCriteria *erosion; /* NULL: its shells do not erode */
} PartRecord;

/* Reference geometry of one shell. */
typedef struct ShellReference {
    bool given, rdt;
    double birth;
    double x[12]; /* corners (corner_count x 3), in the order of the shell's */
    const char *keyword;
    Source source;
} ShellReference;

/* Which geometry an element's constants are of. */
typedef enum Geometry {
    GEOMETRY_MESH,
    GEOMETRY_REFERENCE, /* without the tension that it has in the mesh; the mesh's if there is no reference */
    GEOMETRY_TENSION,   /* with it */
    GEOMETRY_COUNT
} Geometry;

/* Shells of one class share the time from which the reference acts and the rule of the step. */
typedef struct ReferenceClass {
    double birth;
    bool rdt;
} ReferenceClass;

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
    int push[4];      /* 0: the facet bounds the source's volume, but does not feel its pressure */
    int pressure_set; /* -1 none */
    int orientation;  /* of the area vector relative to the stored winding */
    int reference;    /* number of its ReferenceClass, from 1; 0: the mesh is its reference */
} ShellRecord;

typedef struct Builder {
    const Definitions *definitions;
    const BuildOptions *options;
    Diagnostics *diagnostics;
    Model *model;
    DeckIndex index;
    int node_count, shell_count, record_count; /* records: shells, then bare segments */
    size_t record_capacity;
    double *x;               /* (node_count x 3), deck order */
    double *mass;            /* (node_count), deck order */
    double *link_mass;       /* of beams and cables at the nodes (node_count), deck order; NULL if there are none */
    PointMass *point_masses; /* those of the deck (point_mass_count), deck order of nodes */
    int point_mass_count;
    ShellRecord *records;
    PartRecord *parts;
    Motion motion;
    unsigned char *wall_node;   /* nodes named by each wall (wall count x node count), deck order */
    ShellReference *references; /* (shell_count); NULL without reference geometry */
    LIST(ReferenceClass) reference_classes;
    struct ContactSurfaces *contacts; /* (contact count), solver/build_contact.h */
    SurfaceClosure *closures;         /* (airbag count), nodes in deck order until build_renumber */
    double **constants;               /* of each group by Geometry (group count x GEOMETRY_COUNT), NULL where unused */
    unsigned char *implicit;          /* of each record: 1 it is integrated implicitly (record_count); NULL: none is */
    int32_t *order;                   /* element order: order[k] = record of the k-th element in group order */
} Builder;

/* A zeroed block that model_free releases; NULL without memory (reported as an environment error). */
void *builder_alloc(Builder *builder, size_t count, size_t size);
int builder_adopt(Builder *builder, void *block);

/* Kernel input of one record, by positions of all nodes (x 3); x (12) receives the corners in the mesh, which the input
 * points to. */
ElementInput record_input(const Builder *builder, int record, const double *positions, Geometry which, double *x);

/* The section of this number and its place in its list (-1 if there is none). */
SectionKind part_section(const Definitions *definitions, int id, int *place);

/* Whether a part of solids, beams or springs has a material that goes with them; 0, or -1 after an error. */
int part_material_check(Builder *builder, const PartDefinition *definition, const PartRecord *record,
                        const MaterialDefinition *material);

/* The law of a fabric by curves (FORM 4, 14, -14, 24). first_use: messages come once. 0, or -1 after an error. */
int fabric_curve_law(Builder *builder, const MaterialDefinition *material, bool first_use, PartRecord *part);

/* The law of *MAT_MOONEY-RIVLIN_RUBBER and *MAT_OGDEN_RUBBER, likewise. */
int rubber_law(Builder *builder, const MaterialDefinition *material, bool first_use, PartRecord *part);

/* A curve of stress or force over strain that a material's field names, for tension; storage is the Model's. 0, or -1
 * after an error. */
int material_curve(Builder *builder, const MaterialDefinition *material, const char *field, int id, LawCurve *curve);

/* The same for pull and push, or for both senses of a rate: force times scale over what the curve's abscissae are. */
int material_force_curve(Builder *builder, const MaterialDefinition *material, const char *field, int id, double scale,
                         LawCurve *curve);

/* Area of a beam's cross-section, 0 if it is not known. */
double beam_area(const SectionBeamDefinition *section);

/* The stages, in order; 0, or -1 after reporting an error. Later stages need earlier ones to have succeeded. */
int build_parts(Builder *builder);          /* materials, sections -> laws */
int build_shells(Builder *builder);         /* shells -> records, masses */
int build_reference(Builder *builder);      /* reference geometries; masses by them; after build_shells */
int build_reference_mass(Builder *builder); /* their classes, areas and masses; by build_reference */
int check_reference(Builder *builder);      /* its nodes alone, where earlier stages have failed */
int build_links(Builder *builder);          /* beams, springs, cables -> links, masses of nodes; after build_shells */
void mark_link_nodes(const Builder *builder, unsigned char *special); /* by build_renumber */
void renumber_links(Builder *builder, const int32_t *new_index);      /* likewise */
int build_link_ends(Builder *builder);    /* which links share an end, and its mass; after build_renumber */
int build_solids(Builder *builder);       /* solids -> masses of their nodes; after build_shells */
int build_masses(Builder *builder);       /* of *ELEMENT_MASS; after build_links */
int build_point_masses(Builder *builder); /* which of them count, and for which parts; after build_motion */
int build_curves(Builder *builder);       /* and functions */
int build_functions(Builder *builder);    /* by build_curves */
void renumber_functions(Builder *builder, const int32_t *new_index); /* by build_renumber */
int build_spline(Builder *builder, int curve); /* index of a curve's points as a cubic spline; -1 without memory */
int build_surfaces(Builder *builder);          /* airbags' surfaces: orientation and caps */
int build_pressure_sets(Builder *builder);     /* and segment loads -> pressure sets; after build_motion */
int build_airbags(Builder *builder);           /* gas models; after build_surfaces */
int build_connections(Builder *builder);       /* between bags; after build_airbags */
int build_areas(Builder *builder);             /* of the bags' parts at the start; after build_groups */
int build_output(Builder *builder);            /* termination, step control, output plan */
int build_mass_scaling(Builder *builder);      /* DT2MS */
int build_renumber(Builder *builder);          /* node and element order for locality */
int build_groups(Builder *builder);            /* blocks, kernel constants */
int build_implicit(Builder *builder);          /* which small elements are implicit, their factor; by build_groups */
struct NodeRates;
void build_node_shares(Builder *builder, struct NodeRates *rates); /* bound of the mesh's frequency; by build_implicit;
                                                                      rates: workspace, solver/node_rates.h */
int build_rows(Builder *builder);                                  /* segments and rows of corner sums */
int build_walls(Builder *builder);                                 /* rigid walls and their nodes; after build_shells */
int build_wall_nodes(Builder *builder);                        /* the same in the model's order; after build_renumber */
int build_jets(Builder *builder);                              /* after build_groups */
void mark_jet_nodes(Builder *builder, unsigned char *special); /* by build_renumber: NREACT */
int build_sensors(Builder *builder);                           /* after the motion is taken over */
int build_seams(Builder *builder);                             /* seams; after build_shells and lumping */
int build_seam_nodes(Builder *builder); /* in the model's order; after the motion is taken over */
void mark_seam_nodes(const Builder *builder, unsigned char *special); /* by build_renumber */
int build_contacts(Builder *builder);         /* who meets whom, in deck order; after build_shells */
int build_contact_surfaces(Builder *builder); /* triangles, edges, neighbours; after build_renumber */
int build_entities(Builder *builder);         /* contact entities, in deck order; after build_shells */
/* The shape of one of them and where it is, by build_entities. */
int build_entity_shape(Builder *builder, const EntityDefinition *definition, ContactEntity *entity);
int build_entity_nodes(Builder *builder);  /* the same in the model's order; after build_renumber */
int build_erosion_parts(Builder *builder); /* criteria of the parts; after build_parts and build_output */
int build_erosion(
    Builder *builder); /* criteria of the groups, facets of the bags; after build_groups and build_areas */
void mark_bound_nodes(const Model *model, unsigned char *bound);     /* held, driven, hanging, rigid or fixed nodes */
int build_ties(Builder *builder);                                    /* tied nodes; after build_seams */
int build_tie_nodes(Builder *builder);                               /* after build_seam_nodes */
void mark_tie_nodes(const Builder *builder, unsigned char *special); /* by build_renumber */

#endif
