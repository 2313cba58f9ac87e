/* *RIGIDWALL_PLANAR and *RIGIDWALL_GEOMETRIC_FLAT, _SPHERE, _CYLINDER, _PRISM. */
#include <string.h>

#include "io/keyword_table.h"

#define AT(member) offsetof(RigidWallDefinition, member)
static const FieldSpec planar_nodes_fields[] = {
    CARD_INT("NSID", nsid, USED, ID_SET),
    CARD_INT("NSIDEX", nsidex, USED, ID_SET),
    CARD_INT("BOXID", boxid, USED, ID_DEFINE),
    CARD_REAL("OFFSET", offset, USED, LENGTH),
    CARD_REAL("BIRTH", birth, USED, TIME),
    CARD_REAL_OR("DEATH", death, 1e20, USED, TIME),
    CARD_REAL_OR("RWKSF", rwksf, 1.0, LISTED, NONE),
};
static const FieldSpec geometric_nodes_fields[] = {
    CARD_INT("NSID", nsid, USED, ID_SET),           CARD_INT("NSIDEX", nsidex, USED, ID_SET),
    CARD_INT("BOXID", boxid, USED, ID_DEFINE),      CARD_REAL("BIRTH", birth, USED, TIME),
    CARD_REAL_OR("DEATH", death, 1e20, USED, TIME),
};
#define NORMAL_FIELDS                                                                                                  \
    CARD_REAL("XT", tail[0], USED, LENGTH), CARD_REAL("YT", tail[1], USED, LENGTH),                                    \
        CARD_REAL("ZT", tail[2], USED, LENGTH), CARD_REAL("XH", head[0], USED, LENGTH),                                \
        CARD_REAL("YH", head[1], USED, LENGTH), CARD_REAL("ZH", head[2], USED, LENGTH),                                \
        CARD_REAL("FRIC", fric, USED, NONE)
static const FieldSpec planar_normal_fields[] = {NORMAL_FIELDS, CARD_REAL("WVEL", wvel, USED, VELOCITY)};
static const FieldSpec geometric_normal_fields[] = {NORMAL_FIELDS};
#define EDGE_FIELDS                                                                                                    \
    CARD_REAL("XHEV", edge[0], USED, LENGTH), CARD_REAL("YHEV", edge[1], USED, LENGTH),                                \
        CARD_REAL("ZHEV", edge[2], USED, LENGTH), CARD_REAL("LENL", lenl, USED, LENGTH),                               \
        CARD_REAL("LENM", lenm, USED, LENGTH)
static const FieldSpec edge_fields[] = {EDGE_FIELDS};
static const FieldSpec prism_fields[] = {EDGE_FIELDS, CARD_REAL("LENP", lenp, USED, LENGTH)};
static const FieldSpec sphere_fields[] = {CARD_REAL("RADSPH", radius, USED, LENGTH)};
static const FieldSpec moving_fields[] = {CARD_REAL("MASS", mass, USED, MASS), CARD_REAL("V0", v0, USED, VELOCITY)};
static const FieldSpec motion_fields[] = {
    CARD_INT("LCID", lcid, USED, ID_FUNCTION), CARD_INT("OPT", opt, USED, NONE),  CARD_REAL("VX", v[0], USED, NONE),
    CARD_REAL("VY", v[1], USED, NONE),         CARD_REAL("VZ", v[2], USED, NONE),
};
#undef AT

/* A cylinder's card: its segments would need cards of their own. */
typedef struct CylinderCard {
    double radius, length;
    int segments;
} CylinderCard;
#define AT(member) offsetof(CylinderCard, member)
static const FieldSpec cylinder_fields[] = {
    CARD_REAL("RADCYL", radius, USED, LENGTH),
    CARD_REAL("LENCYL", length, USED, LENGTH),
    CARD_INT("NSEGS", segments, REFUSED, NONE),
};
#undef AT

static const FieldSpec forces_fields[] = {
    UNUSED_INT("SOFT", 0, 0), UNUSED_INT("SSID", 1, 0), UNUSED_INT("N1", 2, 0),
    UNUSED_INT("N2", 3, 0),   UNUSED_INT("N3", 4, 0),   UNUSED_INT("N4", 5, 0),
};
static const FieldSpec display_fields[] = {
    UNUSED_INT("PID", 0, 0),
    UNUSED_REAL("RO", 1, 1e-9),
    UNUSED_REAL("E", 2, 1e-4),
    UNUSED_REAL("PR", 3, 0.3),
};

typedef struct IdCard {
    int id;
    char heading[71];
} IdCard;
#define AT(member) offsetof(IdCard, member)
static const FieldSpec id_fields[] = {CARD_INT("ID", id, USED, NONE), CARD_TEXT("TITLE", heading, 70, USED)};
#undef AT

enum { PLANAR_ID, PLANAR_FINITE, PLANAR_MOVING, PLANAR_FORCES, PLANAR_DISPLAY };
enum { PLANAR_NODES, PLANAR_NORMAL, PLANAR_EDGE, PLANAR_MASS, PLANAR_FORCE_CARD };
static const CardSpec planar_cards[] = {
    {"card 1", "", CARD_FIELDS(planar_nodes_fields)},      {"card 2", "", CARD_FIELDS(planar_normal_fields)},
    {"card 4", "with FINITE", CARD_FIELDS(edge_fields)},   {"card 5", "with MOVING", CARD_FIELDS(moving_fields)},
    {"card 6", "with FORCES", CARD_FIELDS(forces_fields)}, {"ID card", "before card 1 with ID", CARD_FIELDS(id_fields)},
};

enum { GEOMETRIC_ID, GEOMETRIC_MOTION, GEOMETRIC_DISPLAY };
enum { GEOMETRIC_NODES, GEOMETRIC_NORMAL, GEOMETRIC_SHAPE, GEOMETRIC_MOTION_CARD, GEOMETRIC_DISPLAY_CARD };
#define GEOMETRIC_CARDS(fields)                                                                                        \
    {                                                                                                                  \
        {"card 1", "", CARD_FIELDS(geometric_nodes_fields)}, {"card 2", "", CARD_FIELDS(geometric_normal_fields)},     \
            {"card 3", "", CARD_FIELDS(fields)}, {"card 4", "with MOTION", CARD_FIELDS(motion_fields)},                \
            {"card 5", "with DISPLAY", CARD_FIELDS(display_fields)},                                                   \
        {                                                                                                              \
            "ID card", "before card 1 with ID", CARD_FIELDS(id_fields)                                                 \
        }                                                                                                              \
    }
static const CardSpec flat_cards[] = GEOMETRIC_CARDS(edge_fields);
static const CardSpec sphere_cards[] = GEOMETRIC_CARDS(sphere_fields);
static const CardSpec cylinder_cards[] = GEOMETRIC_CARDS(cylinder_fields);
static const CardSpec prism_cards[] = GEOMETRIC_CARDS(prism_fields);

static void store_wall(KeywordRead *read, RigidWallDefinition *card)
{
    keyword_transform_point(read, card->tail);
    keyword_transform_point(read, card->head);
    keyword_transform_point(read, card->edge);
    keyword_transform_vector(read, card->v);
    if (card->death == 0.0) card->death = 1e20;
    keyword_check_times(read, "wall", "BIRTH", card->birth, "DEATH", card->death, card->source);
    RigidWallDefinition *wall = KEYWORD_APPEND(read, read->definitions->walls);
    if (wall) *wall = *card;
}

static void read_planar(KeywordRead *read)
{
    while (keyword_more(read) && !read->out_of_memory) {
        RigidWallDefinition card = {.kind = RIGIDWALL_PLANAR,
                                    .finite = keyword_option(read, PLANAR_FINITE),
                                    .moving = keyword_option(read, PLANAR_MOVING)};
        UnusedCard unused;
        keyword_id_card(read, PLANAR_ID, &card.id, card.title);
        int status = keyword_card(read, PLANAR_NODES, &card, true, &card.source);
        if (keyword_card(read, PLANAR_NORMAL, &card, status == 0, &card.plane_source)) status = -1;
        if (card.finite && keyword_card(read, PLANAR_EDGE, &card, status == 0, &card.edge_source)) status = -1;
        if (card.moving && keyword_card(read, PLANAR_MASS, &card, status == 0, &card.moving_source)) status = -1;
        if (keyword_option(read, PLANAR_FORCES) && keyword_card(read, PLANAR_FORCE_CARD, &unused, status == 0, NULL))
            status = -1;
        if (status == 0) store_wall(read, &card);
    }
}

/* The card of the shape. */
static int read_shape(KeywordRead *read, RigidWallDefinition *card)
{
    if (card->kind != RIGIDWALL_CYLINDER) return keyword_card(read, GEOMETRIC_SHAPE, card, true, &card->edge_source);
    CylinderCard cylinder = {0};
    if (keyword_card(read, GEOMETRIC_SHAPE, &cylinder, true, &card->edge_source)) return -1;
    card->radius = cylinder.radius;
    card->lencyl = cylinder.length;
    return 0;
}

static void read_geometric(KeywordRead *read)
{
    const char *shape = read->spec->name + strlen("*RIGIDWALL_GEOMETRIC_");
    while (keyword_more(read) && !read->out_of_memory) {
        RigidWallDefinition card = {.kind = shape[0] == 'F'   ? RIGIDWALL_FLAT
                                            : shape[0] == 'S' ? RIGIDWALL_SPHERE
                                            : shape[0] == 'C' ? RIGIDWALL_CYLINDER
                                                              : RIGIDWALL_PRISM,
                                    .finite = shape[0] == 'F' || shape[0] == 'P',
                                    .motion = keyword_option(read, GEOMETRIC_MOTION)};
        UnusedCard unused;
        keyword_id_card(read, GEOMETRIC_ID, &card.id, card.title);
        int status = keyword_card(read, GEOMETRIC_NODES, &card, true, &card.source);
        if (keyword_card(read, GEOMETRIC_NORMAL, &card, status == 0, &card.plane_source)) status = -1;
        if (status == 0 && read_shape(read, &card)) return; /* what follows cannot be told apart */
        if (card.motion && keyword_card(read, GEOMETRIC_MOTION_CARD, &card, status == 0, &card.moving_source))
            status = -1;
        if (keyword_option(read, GEOMETRIC_DISPLAY) &&
            keyword_card(read, GEOMETRIC_DISPLAY_CARD, &unused, false, NULL) && card_left(read->cards))
            status = -1;
        if (status == 0) store_wall(read, &card);
    }
}

#define GEOMETRIC(shape, spec_cards, text)                                                                             \
    {                                                                                                                  \
        .name = "*RIGIDWALL_GEOMETRIC_" shape, .options = {"ID", "MOTION", "DISPLAY"}, .cards = spec_cards,            \
        .card_count = 6, .read = read_geometric, .remark = text                                                        \
    }
static const KeywordSpec specs[] = {
    {.name = "*RIGIDWALL_PLANAR",
     .options = {"ID", "FINITE", "MOVING", "FORCES", "DISPLAY"},
     .cards = planar_cards,
     .card_count = 6,
     .read = read_planar,
     .remark = "Nodes that start behind the wall may move towards its front only, as in LS-DYNA; `billow check` counts "
               "them. Nodes of moving rigid parts pass unless RWPNAL of *CONTROL_CONTACT is "
               "above 0; they bounce and do not weld. NSID = 0: all nodes, with OFFSET "
               "> 0 those not farther in front than that. FRIC: 0 to 1 Coulomb, 1 no sliding, 2 and 3 weld. The option "
               "ORTHO is refused."},
    GEOMETRIC("FLAT", flat_cards,
              "A rectangle from the tail of n along l and n x l. LENL, LENM = 0: infinite. Else as *RIGIDWALL_PLANAR."),
    GEOMETRIC("SPHERE", sphere_cards, "About the tail of n. Nodes that start inside count as behind."),
    GEOMETRIC("CYLINDER", cylinder_cards,
              "Axis n; LENCYL > 0: from the tail along n, with flat ends. DEFORM and INTERIOR are refused."),
    GEOMETRIC("PRISM", prism_cards, "The rectangle of FLAT, to the depth LENP against n; LENP = 0: infinite."),
};

const KeywordFamily keyword_family_rigidwall = {"Rigid walls", specs, (int)(sizeof specs / sizeof *specs)};
