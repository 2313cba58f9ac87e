/* Nodes, elements and their sections of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_MESH_H
#define BILLOW_DEFINITIONS_MESH_H

#include <stdbool.h>

#include "solver/diagnostics.h"

typedef struct NodeDefinition {
    int id;
    double x[3];
    int tc, rc; /* constraint codes of the NODE card (0..7) */
    Source source;
} NodeDefinition;

typedef struct ShellDefinition {
    int id, part;
    int node[4];         /* a triangle has node[3] == node[2] (degenerate quads are stored so) */
    double thickness[4]; /* _THICKNESS; zero: from the section */
    double beta;         /* degrees, _BETA or the thickness card; valid if has_beta */
    int mcid;            /* _MCID coordinate system; 0 none */
    bool has_beta;
    bool is_face; /* outer face of a solid of a rigid part, made by solid_faces_add; its id is the solid's */
    Source source;
} ShellDefinition;

typedef struct SolidDefinition { /* *ELEMENT_SOLID: wedges and tetrahedra repeat nodes */
    int id, part;
    int node[8];
    Source source;
} SolidDefinition;

typedef struct SectionSolidDefinition {
    int id, elform;
    Source source;
} SectionSolidDefinition;

typedef struct BeamDefinition { /* *ELEMENT_BEAM */
    int id, part;
    int node[3];
    Source source;
} BeamDefinition;

typedef struct SectionBeamDefinition { /* *SECTION_BEAM; which members count depends on elform */
    int id, elform;
    double cst;
    double ts[2], tt[2]; /* 1, 9, 11 */
    double a;            /* 2, 3, 12, 13 */
    double stress;       /* 3 */
    double vol, ca, offset;
    Source source, card2;
} SectionBeamDefinition;

typedef struct DiscreteDefinition { /* *ELEMENT_DISCRETE, *ELEMENT_SEATBELT */
    int id, part;
    int node[2];
    int vid;
    double s, offset;
    bool is_belt; /* *ELEMENT_SEATBELT, with */
    double slack; /* SLEN */
    Source source;
} DiscreteDefinition;

typedef struct SectionDiscreteDefinition {
    int id, dro;
    double kd, v0, cl, fd, cdl, tdl;
    Source source;
} SectionDiscreteDefinition;

typedef struct MassDefinition { /* *ELEMENT_MASS, and _NODE_SET, whose nodes share it equally */
    int id, target;             /* target: node or node set */
    bool is_set;
    double mass;
    int part; /* 0 none */
    Source source;
} MassDefinition;

typedef struct PartMassDefinition { /* *ELEMENT_MASS_PART, _PART_SET: exactly one of addmass and finmass is positive */
    int target;                     /* part or part set */
    bool is_set;
    double addmass, finmass;
    int lcid, mwd;
    Source source;
} PartMassDefinition;

typedef struct SectionShellDefinition {
    int id, elform, propt, icomp, setyp, qr_irid;
    double shrf, nip, t[4], nloc, marea, idof;
    int edgset;
    int beta_count; /* material angles when icomp = 1 */
    double beta[8]; /* degrees, the first eight */
    Source source;
} SectionShellDefinition;

typedef struct HourglassDefinition {
    int id, ihq, ibq;
    double qm, q1, q2, qb_vdc, qw;
    Source source;
} HourglassDefinition;

typedef struct AdaptivityDefinition { /* *CONSTRAINED_ADAPTIVITY: node dnid hangs in the middle of nid1-nid2 */
    int dnid, nid1, nid2;
    Source source;
} AdaptivityDefinition;

#endif
