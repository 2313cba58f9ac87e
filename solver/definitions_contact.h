/* *CONTACT of the deck as written, part of solver/definitions.h. */
#ifndef BILLOW_DEFINITIONS_CONTACT_H
#define BILLOW_DEFINITIONS_CONTACT_H

#include <stdbool.h>

#include "solver/definitions_mesh.h"
#include "solver/diagnostics.h"

/* What a *CONTACT keyword says about who meets whom. */
typedef enum ContactKind {
    CONTACT_SELF,             /* single surface: all its nodes and edges meet all its segments and edges */
    CONTACT_TWO_WAY,          /* the nodes of each surface meet the segments of the other, edges meet edges */
    CONTACT_ONE_WAY,          /* the nodes of surface A meet the segments of surface B */
    CONTACT_NODES_TO_SURFACE, /* likewise; surface A may be a node set */
} ContactKind;

/* *CONTACT_...: fields of all cards that have an effect. Surface A is the manual's SURFA (SSID), B its SURFB (MSID). */
typedef struct ContactDefinition {
    ContactKind kind;
    bool automatic; /* thickness counts without SHLTHK */
    int id;         /* 0 without _ID */
    char title[BILLOW_TITLE_LENGTH];
    int ssid, msid, sstyp, mstyp, sboxid, mboxid;
    double fs, fd, dc, vc, vdc, birth, death;
    double sfs, sfm, sst, mst, sfst, sfmt, fsf, vsf;
    int soft;
    double sofscl;
    int lcidab;
    int thkopt, shlthk, ignore;
    Source source, card1, card2, card3, card_a;
} ContactDefinition;

/* *CONTACT_ENTITY: a smooth shape on a rigid part. */
typedef struct EntityDefinition {
    int pid, geotyp, ssid, sstyp, intord, so, ithk, inout;
    double sf, df, cf, birth, death;
    double centre[3], a[3], b[3]; /* of the local system; a and b zero: the global axes */
    double g[7];
    Source source, card1, card2, card3, card4, card5;
} EntityDefinition;

#endif
