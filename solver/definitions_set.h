/* Sets, curves, functions, coordinate systems and boxes of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_SET_H
#define BILLOW_DEFINITIONS_SET_H

#include <stdbool.h>

#include "solver/billow.h"
#include "solver/diagnostics.h"
#include "solver/function.h"
#include "solver/record_list.h"

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

#endif
