/* *CONTACT cards -> who meets whom, thicknesses and coefficients. */
#include "solver/build_contact.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/facet_map.h"
#include "solver/memory.h"

static const char KEYWORD[] = "*CONTACT";

/* A contact thickness above this share of an element's shortest side would make neighbours in one sheet touch. */
#define THICKEST_SHARE 0.4

/* One side of a contact being resolved. */
typedef struct Side {
    Builder *b;
    const ContactDefinition *card;
    ContactSurfaces *surfaces;
    FacetMap *map;     /* shells by their nodes */
    int32_t *facet_of; /* facet of each shell, -1 none yet (shell count) */
    int side;
    int type, id, box;
    const char *field;
    int cut;         /* facets thinner than SST or MST asks for, since their sides are short */
    double thinnest; /* the least of their thicknesses */
    double given;    /* SST or MST */
} Side;

void contact_surfaces_free(ContactSurfaces *surfaces)
{
    memory_free(surfaces->facets.items);
    memory_free(surfaces->node_side);
    memory_free(surfaces->node_radius);
    *surfaces = (ContactSurfaces){0};
}

static bool in_box(const Side *s, const int32_t *node, int count)
{
    if (!s->box) return true;
    int32_t found = id_map_find(&s->b->index.boxes, s->box);
    if (found < 0) return true; /* reported by check_box */
    const BoxDefinition *box = &s->b->definitions->boxes.items[found];
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            double x = s->b->x[3 * node[i] + k];
            if (x < box->low[k] || x > box->high[k]) return false;
        }
    return true;
}

static double shortest_side(const Builder *b, const int32_t *node, int corners)
{
    double shortest = INFINITY;
    for (int a = 0; a < corners; a++) {
        const double *x = b->x + 3 * node[a], *y = b->x + 3 * node[(a + 1) % corners];
        double length =
            sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]));
        shortest = length < shortest ? length : shortest;
    }
    return shortest;
}

/* Is the thickness of shells taken into account, and of rigid ones? */
static bool thickness_counts(const Builder *b, const ContactDefinition *card, bool rigid)
{
    const ControlDefinitions *control = &b->definitions->control;
    int option = control->contact.given ? control->contact.shlthk : 0;
    if (card->automatic) return true;
    if (card->thkopt == 1) option = card->shlthk;
    if (card->thkopt == 2) option = 0;
    return option == 2 || (option == 1 && !rigid);
}

/* Half the contact thickness of a facet: SST or MST, or the shell's own times SFST or SFMT. */
static double facet_radius(const Builder *b, const ContactDefinition *card, int side, int32_t shell,
                           const int32_t *node)
{
    double given = side == CONTACT_SIDE_A ? card->sst : card->mst;
    double factor = side == CONTACT_SIDE_A ? card->sfst : card->sfmt, thickness = given;
    bool rigid =
        shell >= 0 && b->definitions->materials.items[b->parts[b->records[shell].part].material].kind == MATERIAL_RIGID;
    if (!thickness_counts(b, card, rigid)) return 0.0;
    if (!(given > 0.0)) thickness = shell >= 0 ? factor * b->records[shell].thickness : 0.0;
    double most = THICKEST_SHARE * shortest_side(b, node, node[3] == node[2] ? 3 : 4);
    return 0.5 * (thickness < most ? thickness : most);
}

/* Adds a facet to this side, or the side to the facet. */
static int add_facet(Side *s, int32_t shell, const int32_t *node)
{
    if (!in_box(s, node, node[3] == node[2] ? 3 : 4)) return 0;
    double radius = facet_radius(s->b, s->card, s->side, shell, node);
    if (radius > 0.0 && 2.0 * radius < s->given) {
        s->thinnest = s->cut == 0 ? 2.0 * radius : fmin(s->thinnest, 2.0 * radius);
        s->cut++;
    }
    int32_t known = shell >= 0 ? s->facet_of[shell] : -1;
    if (known >= 0) {
        ContactFacet *facet = &s->surfaces->facets.items[known];
        facet->side |= s->side;
        facet->radius = radius > facet->radius ? radius : facet->radius;
        return 0;
    }
    if (memory_reserve((void **)&s->surfaces->facets.items, &s->surfaces->facets.capacity,
                       s->surfaces->facets.count + 1, sizeof *s->surfaces->facets.items))
        return -1;
    if (shell >= 0) s->facet_of[shell] = (int32_t)s->surfaces->facets.count;
    ContactFacet *facet = &s->surfaces->facets.items[s->surfaces->facets.count++];
    *facet = (ContactFacet){.shell = shell, .side = s->side, .radius = radius};
    memcpy(facet->node, node, sizeof facet->node);
    return 0;
}

static int add_shell(Side *s, int32_t shell)
{
    const ShellRecord *r = &s->b->records[shell];
    int32_t node[4] = {r->node[0], r->node[1], r->node[2], r->corner_count == 3 ? r->node[2] : r->node[3]};
    return add_facet(s, shell, node);
}

static int add_part(Side *s, int32_t part)
{
    const DeckIndex *index = &s->b->index;
    int status = 0;
    for (int32_t k = index->part_shell_start[part]; k < index->part_shell_start[part + 1]; k++)
        status |= add_shell(s, index->part_shell[k]);
    return status;
}

static int add_segments(Side *s)
{
    IndexList set = {0};
    int status = sets_resolve_segments(&s->b->index, s->id, s->card->card1, KEYWORD, &set, s->b->diagnostics), sign;
    for (size_t i = 0; !status && i < set.count; i += 4)
        status = add_facet(s, facet_map_find(s->map, set.items + i, &sign), set.items + i);
    if (!status && set.count == 0) {
        diagnostics_add(s->b->diagnostics, SEVERITY_ERROR, s->card->card1, KEYWORD,
                        "%s = %d is a set of zero segments; add segments to *SET_SEGMENT %d or name another surface",
                        s->field, s->id, s->id);
        status = -1;
    }
    index_list_free(&set);
    return status;
}

/* Nodes of a set, with the thickness of the thickest shell at each. */
static int add_node_set(Side *s)
{
    Builder *b = s->b;
    IndexList set = {0};
    int status = sets_resolve_nodes(&b->index, s->id, s->card->card1, KEYWORD, &set, b->diagnostics);
    for (size_t i = 0; i < set.count; i++)
        if (in_box(s, &set.items[i], 1)) s->surfaces->node_side[set.items[i]] |= (unsigned char)s->side;
    for (int32_t shell = 0; !status && shell < b->shell_count; shell++) {
        const ShellRecord *r = &b->records[shell];
        int32_t node[4] = {r->node[0], r->node[1], r->node[2], r->corner_count == 3 ? r->node[2] : r->node[3]};
        double radius = facet_radius(b, s->card, s->side, shell, node);
        for (int a = 0; a < r->corner_count; a++) {
            double *of_node = &s->surfaces->node_radius[node[a]];
            if (s->surfaces->node_side[node[a]] & s->side) *of_node = radius > *of_node ? radius : *of_node;
        }
    }
    index_list_free(&set);
    return status;
}

static int add_part_set(Side *s, bool exempt)
{
    IndexList set = {0};
    int status = sets_resolve_parts(&s->b->index, s->id, s->card->card1, KEYWORD, &set, s->b->diagnostics);
    size_t next = 0;
    for (int32_t part = 0; !status && part < s->b->model->part_count; part++) {
        bool member = next < set.count && set.items[next] == part;
        next += member;
        if (member != exempt) status = add_part(s, part);
    }
    index_list_free(&set);
    return status;
}

static int add_shell_set(Side *s)
{
    IndexList set = {0};
    int status = sets_resolve_shells(&s->b->index, s->id, s->card->card1, KEYWORD, &set, s->b->diagnostics);
    for (size_t i = 0; !status && i < set.count; i++) status = add_shell(s, set.items[i]);
    index_list_free(&set);
    return status;
}

static int add_named_part(Side *s)
{
    int32_t part = id_map_find(&s->b->index.parts, s->id);
    if (part >= 0) return add_part(s, part);
    diagnostics_add(s->b->diagnostics, SEVERITY_ERROR, s->card->card1, KEYWORD,
                    "%s = %d is not a part of this deck; add a *PART card or correct the id", s->field, s->id);
    return -1;
}

static int add_all(Side *s)
{
    int status = 0;
    for (int32_t shell = 0; !status && shell < s->b->shell_count; shell++) status = add_shell(s, shell);
    return status;
}

static int check_box(const Side *s)
{
    if (!s->box || id_map_find(&s->b->index.boxes, s->box) >= 0) return 0;
    diagnostics_add(s->b->diagnostics, SEVERITY_ERROR, s->card->card1, KEYWORD,
                    "box %d of %s is not defined by *DEFINE_BOX", s->box,
                    s->side == CONTACT_SIDE_A ? "SBOXID" : "MBOXID");
    return -1;
}

static int resolve_side(Side *s)
{
    size_t before = s->surfaces->facets.count;
    int status = check_box(s);
    if (s->type == 5 || s->id == 0)
        status |= add_all(s);
    else if (s->type == 0)
        status |= add_segments(s);
    else if (s->type == 1)
        status |= add_shell_set(s);
    else if (s->type == 3)
        status |= add_named_part(s);
    else if (s->type == 4)
        status |= add_node_set(s);
    else
        status |= add_part_set(s, s->type == 6);
    if (status) return -1;
    bool empty = s->surfaces->facets.count == before;
    for (size_t i = 0; empty && i < before; i++) empty = !(s->surfaces->facets.items[i].side & s->side);
    for (int i = 0; empty && s->type == 4 && i < s->b->node_count; i++) empty = !(s->surfaces->node_side[i] & s->side);
    if (!empty) return 0;
    diagnostics_add(s->b->diagnostics, SEVERITY_ERROR, s->card->card1, KEYWORD,
                    "%s = %d of type %d holds no %s, so side %s of the contact is empty; name parts that have shells",
                    s->field, s->id, s->type, s->type == 4 ? "nodes" : "shells or segments",
                    s->side == CONTACT_SIDE_A ? "A" : "B");
    return -1;
}

/* A thickness that was asked for and cannot be had. */
static void warn_of_cut(const Side *s)
{
    if (s->cut == 0) return;
    diagnostics_add(s->b->diagnostics, SEVERITY_WARNING, s->card->card3, KEYWORD,
                    "%s = %g is more than %g of the shortest side of %d shells or segments, which get no more than "
                    "that (at least %.3g), or neighbours in one sheet would touch; give a smaller %s or a coarser mesh",
                    s->side == CONTACT_SIDE_A ? "SST" : "MST", s->given, THICKEST_SHARE, s->cut, s->thinnest,
                    s->side == CONTACT_SIDE_A ? "SST" : "MST");
}

/* Nodes of the facets meet triangles too, except those of the surface that is only met. */
static void mark_nodes(const ContactDefinition *card, ContactSurfaces *surfaces)
{
    bool one_way = card->kind == CONTACT_ONE_WAY || card->kind == CONTACT_NODES_TO_SURFACE;
    for (size_t i = 0; i < surfaces->facets.count; i++) {
        const ContactFacet *facet = &surfaces->facets.items[i];
        int side = one_way ? facet->side & CONTACT_SIDE_A : facet->side;
        if (!side) continue;
        for (int a = 0; a < 4; a++) {
            double *radius = &surfaces->node_radius[facet->node[a]];
            surfaces->node_side[facet->node[a]] |= (unsigned char)side;
            *radius = facet->radius > *radius ? facet->radius : *radius;
        }
    }
}

/* A contact that counts thickness and has none anywhere cannot push. */
static int check_thickness(Builder *b, const ContactDefinition *card, const ContactSurfaces *surfaces)
{
    if (!thickness_counts(b, card, false)) return 0;
    for (size_t i = 0; i < surfaces->facets.count; i++)
        if (surfaces->facets.items[i].radius > 0.0) return 0;
    for (int i = 0; i < b->node_count; i++)
        if (surfaces->node_radius[i] > 0.0) return 0;
    diagnostics_add(
        b->diagnostics, SEVERITY_ERROR, card->card1, KEYWORD,
        "the thickness of all shells of this contact is zero; give T1 in *SECTION_SHELL or SST and MST on card "
        "3");
    return -1;
}

static int resolve_contact(Builder *b, FacetMap *map, const ContactDefinition *card, ContactSurfaces *surfaces)
{
    int32_t *facet_of = memory_alloc((size_t)b->shell_count + 1, sizeof *facet_of);
    surfaces->node_side = memory_alloc((size_t)b->node_count + 1, 1);
    surfaces->node_radius = memory_alloc((size_t)b->node_count + 1, sizeof(double));
    int status = facet_of && surfaces->node_side && surfaces->node_radius ? 0 : -1;
    for (int i = 0; !status && i < b->shell_count; i++) facet_of[i] = -1;
    bool self = card->kind == CONTACT_SELF;
    Side a = {b,           card,       surfaces,     map,    facet_of,          CONTACT_SIDE_A,
              card->sstyp, card->ssid, card->sboxid, "SSID", .given = card->sst};
    Side other = {b,           card,       surfaces,     map,    facet_of,          CONTACT_SIDE_B,
                  card->mstyp, card->msid, card->mboxid, "MSID", .given = card->mst};
    if (!status) {
        status = resolve_side(&a);
        if (!self && resolve_side(&other)) status = -1;
    }
    for (size_t i = 0; self && i < surfaces->facets.count; i++)
        surfaces->facets.items[i].side = CONTACT_SIDE_A | CONTACT_SIDE_B;
    if (!status) {
        warn_of_cut(&a);
        warn_of_cut(&other);
        mark_nodes(card, surfaces);
        status = check_thickness(b, card, surfaces);
    }
    memory_free(facet_of);
    return status;
}

/* Share of the stability limit 4 m/dt^2 that the penalty takes: SOFSCL, or SLSFAC with SFS or SFM. */
static void set_coefficients(const Builder *b, const ContactDefinition *card, ContactInterface *contact)
{
    const ControlDefinitions *control = &b->definitions->control;
    double scale = control->contact.given && control->contact.slsfac > 0.0 ? control->contact.slsfac : 0.1;
    contact->stiffness[0] = card->soft == 0 ? scale * card->sfs : card->sofscl;
    contact->stiffness[1] = card->soft == 0 ? scale * card->sfm : card->sofscl;
    contact->static_friction = card->fsf * card->fs;
    contact->dynamic_friction = card->fsf * card->fd;
    contact->decay = card->dc;
    contact->damping = 0.01 * card->vdc;
    contact->birth = card->birth;
    contact->death = card->death;
    contact->ignore = card->ignore ? card->ignore : control->contact.given ? control->contact.ignore : 0;
    contact->kind = card->kind;
    contact->source = card->card1;
    memcpy(contact->title, card->title, sizeof contact->title);
}

int build_contacts(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    size_t count = d->contacts.count;
    if (count == 0) return 0;
    m->contact_count = (int)count;
    m->eroded_nodes_stay = d->control.contact.given && d->control.contact.enmass == 2;
    m->contacts = builder_alloc(b, count, sizeof *m->contacts);
    b->contacts = memory_alloc(count, sizeof *b->contacts);
    FacetMap map = {0};
    if (!m->contacts || !b->contacts ||
        facet_map_build(&map, b->records[0].node, (size_t)b->shell_count, sizeof *b->records))
        return -1;
    int status = 0;
    for (size_t i = 0; i < count; i++) {
        const ContactDefinition *card = &d->contacts.items[i];
        ContactInterface *contact = &m->contacts[i];
        contact->id = card->id ? card->id : (int)i + 1;
        contact->thickness_curve = -1;
        if (resolve_contact(b, &map, card, &b->contacts[i])) status = -1;
        set_coefficients(b, card, contact);
        if (!card->lcidab) continue;
        contact->thickness_curve =
            deck_index_curve(&b->index, card->lcidab, "LCIDAB", card->card_a, KEYWORD, b->diagnostics);
        if (contact->thickness_curve < 0) status = -1;
    }
    facet_map_free(&map);
    return status;
}
