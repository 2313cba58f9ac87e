/* The deck as written: one record per keyword item, each with its place in the deck.
 * Filled by io/ (readers), consumed by solver/build_*.c, which validates and makes the Model.
 * Values are the deck's own units; defaults of the manual are already applied by the readers (zero or blank), names are
 * those of the cards in lower case. Ids are the user's. Zero means "not given" for ids of optional things. */
#ifndef BILLOW_DEFINITIONS_H
#define BILLOW_DEFINITIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "airbag/billow_sensor.h"
#include "solver/billow.h"
#include "solver/definitions_reference.h"
#include "solver/diagnostics.h"
#include "solver/function.h"

/* A growing array of records: item type T, e.g. LIST(NodeDefinition) nodes. Grow with memory_reserve. */
#define LIST(T)                                                                                                        \
    struct {                                                                                                           \
        T *items;                                                                                                      \
        size_t count;                                                                                                  \
        size_t capacity;                                                                                               \
    }

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

/* Cards of *PART_INERTIA and *CONSTRAINED_NODAL_RIGID_BODY_INERTIA. */
typedef struct InertiaCard {
    double centre[3], tm;
    int ircs, nodeid;
    double i[6]; /* xx xy xz yy yz zz */
    double v[3], w[3];
    double x_axis[3], in_plane[3]; /* IRCS = 1: vectors of the local axes, unless cid */
    int cid;
    Source source, tensor_source, axes_source;
} InertiaCard;

typedef struct PartDefinition {
    int id, section, material, eosid, hourglass, grav, adpopt, tmid;
    char title[BILLOW_TITLE_LENGTH];
    bool has_inertia;
    InertiaCard inertia;
    Source source;
} PartDefinition;

typedef struct RigidMergeDefinition { /* *CONSTRAINED_RIGID_BODIES: part other becomes one body with part lead */
    int lead, other, iflag;
    Source source;
} RigidMergeDefinition;

typedef struct ExtraNodesDefinition { /* *CONSTRAINED_EXTRA_NODES_NODE / _SET: nodes that follow a rigid part */
    bool is_set;
    int part, id, iflag;
    Source source;
} ExtraNodesDefinition;

typedef struct NodalRigidBodyDefinition { /* *CONSTRAINED_NODAL_RIGID_BODY: a node set as a rigid body */
    int id, cid, nsid, pnode, iprt, drflag, rrflag;
    bool has_spc, has_inertia;
    double cmo, con1, con2;
    char title[BILLOW_TITLE_LENGTH];
    InertiaCard inertia;
    Source source, spc_source;
} NodalRigidBodyDefinition;

typedef struct SectionShellDefinition {
    int id, elform, propt, icomp, setyp, qr_irid;
    double shrf, nip, t[4], nloc, marea, idof;
    int edgset;
    int beta_count; /* material angles when icomp = 1 */
    double beta[8]; /* degrees, the first eight */
    Source source;
} SectionShellDefinition;

typedef enum MaterialKind {
    MATERIAL_FABRIC,
    MATERIAL_ELASTIC,
    MATERIAL_NULL,
    MATERIAL_RIGID,
    MATERIAL_SPRING,      /* *MAT_SPRING_ELASTIC: k */
    MATERIAL_CABLE,       /* *MAT_CABLE_DISCRETE_BEAM: ro, e, f0 */
    MATERIAL_ORTHOTROPIC, /* *MAT_ORTHOTROPIC_ELASTIC: the card of a fabric of FORM 2 */
    MATERIAL_RUBBER,      /* *MAT_MOONEY-RIVLIN_RUBBER, *MAT_OGDEN_RUBBER */
    MATERIAL_BELT,        /* *MAT_SEATBELT */
} MaterialKind;

/* *MAT_FABRIC (MAT_034): every field of the cards, names as in the manual; *MAT_FABRIC_MAP's PXX, PYY and SXY are in
 * lca, lcb and lcab. */
typedef struct FabricCard {
    bool is_map;
    double ea, eb, prba, prab;
    double gab, cse, el, prl, lratio, damp;
    double aopt, flc, fac, ela, lnrc, fvopt, tsrfac;
    int form;
    double rgbrth, a0ref, a1, a2, a3, x0, x1;
    double v1, v2, v3, beta;
    int isrefg;
    int lca, lcb, lcab, lcua, lcub, lcuab; /* forms 4, 14, -14, 24 */
    double rl;
    int lcaa, lcbb; /* form -14 */
    double h, dt, ecoat, scoat, tcoat;
} FabricCard;

/* *MAT_MOONEY-RIVLIN_RUBBER and *MAT_OGDEN_RUBBER. */
typedef struct RubberCard {
    bool is_ogden;
    double a, b, ref, sgl, sw, st, g, sigf, mu[8], alpha[8];
    int lcid, n, nv;
} RubberCard;

/* *MAT_RIGID. con1/con2 as written; lco_or_a1 may name a local system when cmo < 0. */
typedef struct RigidCard {
    double e, pr, n, couple, m;
    char alias[11];
    double cmo;
    double con1, con2;
    double lco_or_a1, a2, a3, v1, v2, v3;
} RigidCard;

typedef struct MaterialDefinition {
    int id;
    MaterialKind kind;
    char title[BILLOW_TITLE_LENGTH];
    double ro;
    double e, pr, da, db, k;     /* MAT_ELASTIC; MAT_NULL's YM and PR are in e and pr */
    double pc, mu, terod, cerod; /* MAT_NULL */
    double f0;                   /* MAT_CABLE_DISCRETE_BEAM */
    int llcid;                   /* MAT_SEATBELT; its MPUL is in ro */
    const char *keyword;         /* as messages call it, a constant of the reader; NULL: *MAT_FABRIC and others' own */
    FabricCard fabric;
    RubberCard rubber;
    RigidCard rigid;
    Source source;
} MaterialDefinition;

typedef struct HourglassDefinition {
    int id, ihq, ibq;
    double qm, q1, q2, qb_vdc, qw;
    Source source;
} HourglassDefinition;

typedef enum SetKind { SET_NODE, SET_PART, SET_SHELL, SET_SEGMENT } SetKind;

typedef struct SegmentDefinition {
    int node[4]; /* a triangle has node[3] == node[2] */
    Source source;
} SegmentDefinition;

/* One line of a _GENERAL set: option ("ALL", "NODE", "PART", "BOX", "DNODE", "SEG", "SHELL", "SET_SHELL", ...), and its
 * entity numbers e1..e7. _LIST members come as one clause "LIST_MEMBERS" in items; _GENERATE ranges as clauses
 * "RANGE" with first, last, increment in e[0..2]. Boxes are resolved against the initial coordinates. */
typedef struct SetClause {
    char option[16];
    double e[7];
    Source source;
} SetClause;

typedef struct SetDefinition {
    SetKind kind;
    int id;
    char title[BILLOW_TITLE_LENGTH];
    double da[4];
    LIST(int) members;                /* _LIST: ids as written, zeros left out */
    LIST(SetClause) clauses;          /* _GENERATE and _GENERAL */
    LIST(SegmentDefinition) segments; /* *SET_SEGMENT */
    Source source;
} SetDefinition;

typedef struct CurveDefinition {
    int id, sidr, dattyp, lcint;
    double sfa, sfo, offa, offo;
    char title[BILLOW_TITLE_LENGTH];
    LIST(double) x; /* abscissae as written */
    LIST(double) y;
    LIST(int) lines; /* line of each point */
    Source source;
} CurveDefinition;

/* *DEFINE_CURVE_FUNCTION and *DEFINE_FUNCTION, compiled; owns program.code. */
typedef struct FunctionDefinition {
    int id, sidr;
    bool is_curve; /* *DEFINE_CURVE_FUNCTION: shares its ids with *DEFINE_CURVE */
    char title[BILLOW_TITLE_LENGTH];
    FunctionProgram program;
    Source source;
} FunctionDefinition;

/* *DEFINE_COORDINATE_NODES: three nodes; _SYSTEM: origin, point on x, point in xy; _VECTOR: x axis and xy vector. */
typedef struct CoordinateDefinition {
    enum { COORDINATE_NODES, COORDINATE_SYSTEM, COORDINATE_VECTOR } kind;
    int id;
    int node[3], flag, cidl, nid;
    char dir;                                  /* 'X', 'Y' or 'Z' of _NODES */
    double origin[3], x_point[3], xy_point[3]; /* _SYSTEM; _VECTOR puts its vectors in x_point and xy_point */
    Source source;
} CoordinateDefinition;

typedef struct VectorDefinition {
    int id, cid;
    double tail[3], head[3];
    Source source;
} VectorDefinition;

typedef struct BoxDefinition {
    int id;
    double low[3], high[3];
    Source source;
} BoxDefinition;

typedef struct AdaptivityDefinition { /* *CONSTRAINED_ADAPTIVITY: node dnid hangs in the middle of nid1-nid2 */
    int dnid, nid1, nid2;
    Source source;
} AdaptivityDefinition;

typedef struct ControlDefinitions {
    struct {
        double endtim, dtmin, endeng, endmas, nosol;
        int endcyc;
        Source source;
        bool given;
    } termination;
    struct {
        double dtinit, tssfac, tslimt, dt2ms, dt2msf;
        int isdo, lctm, erode, ms1st, dt2mslc, imscl, rmscl, ihdo;
        double emscl;
        Source source;
        bool given;
    } timestep;
    struct {
        int ihq;
        double qh;
        Source source;
        bool given;
    } hourglass;
    struct {
        int hgen, rwen, slnten, rylen, irgen, maten, drlen, disen;
        Source source;
        bool given;
    } energy;
    struct {
        int osu, inn, pidosu, iacc;
        double exacc;
        Source source;
        bool given;
    } accuracy;
    struct {
        double q1, q2;
        int type, btype, tstype;
        Source source;
        bool given;
    } bulk_viscosity;
    struct {
        double wrpang;
        int esort, irnxx, istupd, theory, bwc, miter, proj;
        Source source;
        bool given;
    } shell;
    struct {
        int npopt, neecho, nrefup, iaccop, ipnint, ikedit, iflush, iprtf;
        double opifs;
        Source source;
        bool given;
    } output;
    struct { /* *CONTROL_DYNAMIC_RELAXATION */
        int nrcyck, irelal, idrflg;
        double drtol, drfctr, drterm, tssfdr, edttl;
        Source source;
        bool given;
    } relaxation;
} ControlDefinitions;

/* *DATABASE_<name>: output interval of one result. */
typedef struct DatabaseDefinition {
    char name[32]; /* "ABSTAT", "GLSTAT", "BINARY_D3PLOT", ... */
    double dt;     /* interval of time; of BINARY_D3DUMP and BINARY_RUNRSF in cycles */
    int lcur;      /* curve of intervals over time; 0 none */
    int npltc;     /* BINARY_D3PLOT: > 0 asks for this many states up to ENDTIM, dt is then ENDTIM / NPLTC */
    Source source;
} DatabaseDefinition;

typedef struct HistoryDefinition { /* *DATABASE_HISTORY_NODE(_SET) */
    bool is_set;
    int id;
    Source source;
} HistoryDefinition;

typedef struct SpcDefinition { /* *BOUNDARY_SPC_NODE / _SET (_ID, _BIRTH_DEATH) */
    bool is_set;
    int id, cid;
    int dof[6]; /* x y z rx ry rz, 1 = fixed */
    double birth, death;
    Source source;
} SpcDefinition;

typedef struct PrescribedMotionDefinition {
    enum { MOTION_NODE, MOTION_SET, MOTION_RIGID } kind;
    int id, dof, vad, lcid, vid;
    double sf, death, birth;
    double offset1, offset2; /* card 2 for |dof| = 9, 10, 11 */
    Source source;
} PrescribedMotionDefinition;

typedef struct InitialVelocityDefinition {
    enum {
        VELOCITY_ALL,        /* *INITIAL_VELOCITY: nsid (0 = all), nsidex, boxid, irigid */
        VELOCITY_NODE,       /* *INITIAL_VELOCITY_NODE: id */
        VELOCITY_GENERATION, /* id of styp; omega about an axis */
        VELOCITY_RIGID_BODY  /* part id */
    } kind;
    int id, styp, nsidex, boxid, irigid, icid, phase, ivatn;
    double v[3], w[3];   /* translation and rotation rates */
    double vx_exempt[6]; /* card for exempted nodes: vxe vye vze vxre vyre vzre */
    double omega, centre[3], axis[3];
    Source source;
} InitialVelocityDefinition;

typedef struct NodeLoadDefinition { /* *LOAD_NODE_POINT / _SET */
    bool is_set;
    int id, dof, lcid, cid, m1, m2, m3;
    double sf;
    Source source;
} NodeLoadDefinition;

typedef struct SegmentLoadDefinition { /* *LOAD_SEGMENT / _SET (_ID): pressure from curve lcid times sf, arrival time at
                                        */
    bool is_set;
    int id; /* set id, or 0 */
    int lcid;
    double sf, at;
    int node[4];
    Source source;
} SegmentLoadDefinition;

typedef struct BodyLoadDefinition { /* *LOAD_BODY_X/Y/Z */
    int axis;                       /* 0, 1, 2 */
    int lcid, lciddr, cid;
    double sf, xc, yc, zc;
    Source source;
} BodyLoadDefinition;

typedef struct GravityPartDefinition { /* *LOAD_GRAVITY_PART / _SET */
    bool is_set;
    int id, dof, lc, lcdr, stga, stgr;
    double accel;
    Source source;
} GravityPartDefinition;

typedef struct DampingDefinition { /* *DAMPING_GLOBAL (part 0) and *DAMPING_PART_MASS(_SET) */
    bool is_global, is_set;
    int id, lcid, flag;
    double sf;    /* factor on the curve, or valdmp of DAMPING_GLOBAL when lcid = 0 */
    double st[6]; /* scale factors x y z rx ry rz; all zero means all one */
    Source source;
} DampingDefinition;

enum { BILLOW_AIRBAG_GASES = 17 }; /* of one mixture, as in the manual */

typedef enum AirbagModel {
    AIRBAG_SIMPLE,
    AIRBAG_WANG_NEFSKE,
    AIRBAG_HYBRID,
    AIRBAG_CHEMKIN,
    AIRBAG_PRESSURE_VOLUME,
    AIRBAG_ADIABATIC,
    AIRBAG_LOAD_CURVE,
    AIRBAG_LINEAR_FLUID,
    AIRBAG_FLUID_AND_GAS,
} AirbagModel;

/* One gas of *AIRBAG_HYBRID (cards 5.1, 5.2) or *AIRBAG_HYBRID_CHEMKIN (cards 6, 7). */
typedef struct AirbagGasDefinition {
    int lcidm, lcidt; /* HYBRID */
    double mw, initm, a, b, c, fmass;
    char chname[11]; /* CHEMKIN */
    int lcidn;
    double fmole, fmolet;
    double tlow, tmid, thigh, low[7], high[7]; /* DATA = 1: a b c d e f h */
    double d, e;                               /* DATA = 3, with a b c */
    Source source;                             /* of the first card */
} AirbagGasDefinition;

/* Cards 2a or 2b of *AIRBAG with RBID. */
typedef struct SensorCards {
    double a[4], tdur, dv[4], u[4]; /* levels of x, y, z and magnitude */
    int n;                          /* user's constants */
    double c[BILLOW_SENSOR_CONSTANTS];
} SensorCards;

/* Cards 9 to 11 of *AIRBAG_WANG_NEFSKE_JETTING and the like. */
typedef struct JetCards {
    bool given, multiple, cm;
    double focus[3], head[3], second[3];
    double ca, beta; /* ca: CA or LCJRV */
    int psid;
    double angle;
    int node[3], nreact;
    Source card9, card10, card11;
} JetCards;

/* *AIRBAG_<model>(_ID): cards as in the manual; the Source of every card so that messages name the right line. */
typedef struct AirbagDefinition {
    AirbagModel model;
    int id; /* 0 without _ID */
    char heading[BILLOW_TITLE_LENGTH];
    int sid, sidtyp, rbid;
    double vsca, psca, vini, mwd, spsf;
    double cv, cp, t;
    int lcid;                           /* SIMPLE: mass flow curve */
    double mu, area, pe, ro;            /* SIMPLE card 3 */
    int lou;                            /* SIMPLE card 4 */
    double text, a, b, mw, gasc, hconv; /* SIMPLE 4a, WANG_NEFSKE 7 */
    int lct, lcmt, lcdt;                /* WANG_NEFSKE 3 */
    double tvol, iabt;
    double c23, a23, cp23, ap23; /* WANG_NEFSKE 4 */
    int lcc23, lca23, lccp23, lcap23;
    double gc, pover, ppop, opt; /* WANG_NEFSKE 5 (pe, ro above) */
    int lcefr, knkdn;
    double ioc, ioa, ivol, iro, it; /* WANG_NEFSKE 6 */
    int lcbf;
    double tdp, axp, ayp, azp, amagp, tdurp, tda; /* WANG_NEFSKE 8, option POP */
    int rbidp;
    double atmost, atmosp, atmosd, cc; /* HYBRID 3, with gc, hconv; CHEMKIN 3 has atmost, atmosp and gc as RG */
    int ngas;                          /* HYBRID 5, with opt, lcefr, ppop as PVENT; CHEMKIN 3 */
    int lcidm0, vntopt, lcidm, lcidt, data;
    AirbagGasDefinition gases[BILLOW_AIRBAG_GASES]; /* (ngas) */
    double cn, beta;                                /* SIMPLE_PRESSURE_VOLUME 3, with lcid */
    int lciddr;
    double psf, gamma, p0; /* ADIABATIC_GAS_MODEL 3, with lcid, pe, ro; LOAD_CURVE 3 has p0, pe, ro, t too */
    double stime, t0;      /* LOAD_CURVE 3, with lcid */
    double bulk;           /* LINEAR_FLUID 3, with ro, lcid */
    int lcint, lcoutt, lcoutp, lcfit, lcbulk;
    double p_limit; /* LINEAR_FLUID 4 */
    int p_limlc, nonull;
    double xwini, xwadd, xw, p, tend; /* FLUID_AND_GAS 3, with ro */
    int lcxw, lcp;
    double gdir, kappa, kbm; /* FLUID_AND_GAS 4 */
    int nproj, idir, iidir;
    SensorCards sensor;
    JetCards jet;
    Source source, card1, card3, card4, card5, card6, card7, card8;
} AirbagDefinition;

/* *MAT_ADD_AIRBAG_POROSITY_LEAKAGE: names as those of FabricCard. */
typedef struct PorosityDefinition {
    int mid;
    double flc, fac, ela, fvopt, x0, x1;
    Source source;
} PorosityDefinition;

/* *AIRBAG_INTERACTION */
typedef struct InteractionDefinition {
    int ab1, ab2;
    double area, sf;
    int pid, lcid, iflow, excp;
    Source source;
} InteractionDefinition;

/* *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC_FLAT, _SPHERE, _CYLINDER, _PRISM with their options. */
typedef struct RigidWallDefinition {
    enum { RIGIDWALL_PLANAR, RIGIDWALL_FLAT, RIGIDWALL_SPHERE, RIGIDWALL_CYLINDER, RIGIDWALL_PRISM } kind;
    bool finite, moving, motion; /* options: card with edges, with mass, with a curve */
    int id;                      /* 0 without _ID */
    char title[BILLOW_TITLE_LENGTH];
    int nsid, nsidex, boxid;
    double offset, birth, death, rwksf;
    double tail[3], head[3], fric, wvel;
    double edge[3], lenl, lenm, lenp; /* edge: head of the vector l, whose tail is that of n */
    double radius, lencyl;
    double mass, v0;
    int lcid, opt;
    double v[3];
    Source source, plane_source, edge_source, moving_source;
} RigidWallDefinition;

/* Everything of one deck. Zero-initialise, fill with deck_read (io/read.h), free with definitions_free. */
typedef struct Definitions {
    char title[BILLOW_TITLE_LENGTH];
    bool incomplete; /* a reader reported an error, so records may be missing: "X is not defined" would be its echo */
    LIST(NodeDefinition) nodes;
    LIST(ShellDefinition) shells;
    size_t face_count; /* the last so many shells are faces of solids */
    LIST(SolidDefinition) solids;
    LIST(SectionSolidDefinition) solid_sections;
    LIST(BeamDefinition) beams;
    LIST(SectionBeamDefinition) beam_sections;
    LIST(DiscreteDefinition) discretes;
    LIST(SectionDiscreteDefinition) discrete_sections;
    LIST(PartDefinition) parts;
    LIST(SectionShellDefinition) sections;
    LIST(MaterialDefinition) materials;
    LIST(HourglassDefinition) hourglasses;
    LIST(SetDefinition) sets;
    LIST(CurveDefinition) curves;
    LIST(FunctionDefinition) functions;
    LIST(CoordinateDefinition) coordinates;
    LIST(VectorDefinition) vectors;
    LIST(BoxDefinition) boxes;
    LIST(AdaptivityDefinition) adaptivities;
    ControlDefinitions control;
    LIST(DatabaseDefinition) databases;
    LIST(HistoryDefinition) histories;
    LIST(SpcDefinition) spcs;
    LIST(PrescribedMotionDefinition) motions;
    LIST(InitialVelocityDefinition) velocities;
    LIST(NodeLoadDefinition) node_loads;
    LIST(SegmentLoadDefinition) segment_loads;
    LIST(BodyLoadDefinition) body_loads;
    LIST(GravityPartDefinition) gravity_parts;
    LIST(DampingDefinition) dampings;
    LIST(AirbagDefinition) airbags;
    LIST(InteractionDefinition) interactions;
    LIST(PorosityDefinition) porosities;
    LIST(RigidWallDefinition) walls;
    LIST(RigidMergeDefinition) merges;
    LIST(ExtraNodesDefinition) extra_nodes;
    LIST(NodalRigidBodyDefinition) nodal_bodies;
    LIST(ReferenceBlockDefinition) reference_blocks;
    LIST(ReferenceNodeDefinition) reference_nodes;
    LIST(ReferenceShellDefinition) reference_shells;
} Definitions;

void definitions_free(Definitions *definitions);

#endif
