/* Gravity and mass damping: every node gets the class with the sum of what acts on its parts, weighted by their masses.
 */
#include <stddef.h>
#include <string.h>

#include "solver/class_cards.h"
#include "solver/memory.h"

static const char *const KEYWORD = "*LOAD_BODY";

/* What the cards say, and the classes that come of it. */
typedef struct Recipes {
    ClassCards cards;
    int32_t *class_of_part; /* (part count) */
    int32_t everywhere;     /* class of what belongs to no part */
    ClassTable table;
} Recipes;

/* A node's shares of mass by class of part: nodes of one class only need none. */
typedef struct Shares {
    int32_t *only;   /* the single class of the node, -1 no shell, -2 several (node count) */
    int32_t *row;    /* row of weights for nodes of several classes (node count) */
    double *weights; /* (rows x class count) */
    size_t class_count;
} Shares;

/* The class of each part's inner nodes. */
static int class_parts(const MotionInput *input, Recipes *recipes, Diagnostics *diagnostics)
{
    size_t parts = input->index->definitions->parts.count;
    BodyClass empty;
    body_class_clear(&empty);
    if (class_table_find(&recipes->table, &empty) < 0) return motion_no_memory(KEYWORD, diagnostics);
    recipes->everywhere = class_table_find(&recipes->table, &recipes->cards.everywhere);
    if (recipes->everywhere < 0) return motion_no_memory(KEYWORD, diagnostics);
    for (size_t p = 0; p < parts; p++) {
        if (!body_class_add(&recipes->cards.of_part[p], &recipes->cards.everywhere, 1)) {
            class_report_full(KEYWORD, input->index->definitions->parts.items[p].source, diagnostics);
            return -1;
        }
        recipes->class_of_part[p] = class_table_find(&recipes->table, &recipes->cards.of_part[p]);
        if (recipes->class_of_part[p] < 0) return motion_no_memory(KEYWORD, diagnostics);
    }
    return 0;
}

/* The class of a mass on a node: that of the part for which it counts, else what acts everywhere. */
static int32_t point_class(const MotionInput *input, const Motion *motion, const Recipes *recipes,
                           const PointMass *point)
{
    const int body = motion->node_body[point->node];
    int32_t part = point->part;
    if (part < 0 && body >= 0 && !motion->rigid_bodies[body].nodal)
        part = id_map_find(&input->index->parts, motion->rigid_bodies[body].part_id);
    return part >= 0 ? recipes->class_of_part[part] : recipes->everywhere;
}

/* Calls visit(shares, node, class, mass) for every mass on a node and every shell corner. */
static void visit_corners(const MotionInput *input, const Motion *motion, const Recipes *recipes, Shares *shares,
                          void (*visit)(Shares *, int32_t, int32_t, double))
{
    for (int i = 0; i < input->point_mass_count; i++) {
        const PointMass *point = &input->point_masses[i];
        visit(shares, point->node, point_class(input, motion, recipes, point), point->mass);
    }
    const DeckIndex *index = input->index;
    const Definitions *d = index->definitions;
    for (size_t p = 0; p < d->parts.count; p++) {
        for (int32_t k = index->part_shell_start[p]; k < index->part_shell_start[p + 1]; k++) {
            const ShellDefinition *shell = &d->shells.items[index->part_shell[k]];
            int corners = shell->node[3] == shell->node[2] ? 3 : 4;
            double mass = input->shell_mass ? input->shell_mass[index->part_shell[k]] : 1;
            for (int c = 0; c < corners; c++) {
                int32_t node = id_map_find(&index->nodes, shell->node[c]);
                if (node >= 0) visit(shares, node, recipes->class_of_part[p], mass / corners);
            }
        }
    }
}

static void note_class(Shares *shares, int32_t node, int32_t part_class, double mass)
{
    (void)mass;
    if (shares->only[node] == -1) {
        shares->only[node] = part_class;
    } else if (shares->only[node] != part_class) {
        shares->only[node] = -2;
    }
}

static void add_share(Shares *shares, int32_t node, int32_t part_class, double mass)
{
    if (shares->row[node] >= 0)
        shares->weights[(size_t)shares->row[node] * shares->class_count + (size_t)part_class] += mass;
}

/* Hanging nodes give half their mass, with its class, to each end. */
static void note_hanging(const Constraints *constraints, Shares *shares)
{
    for (int h = constraints->hanging_count; h-- > 0;) {
        const HangingNode *hanging = &constraints->hanging[h];
        int32_t own = shares->only[hanging->node];
        for (int e = 0; e < 2 && own != -1; e++) {
            if (own == -2) {
                shares->only[hanging->end[e]] = -2;
            } else {
                note_class(shares, hanging->end[e], own, 0);
            }
        }
    }
}

static void add_hanging(const Constraints *constraints, Shares *shares)
{
    for (int h = constraints->hanging_count; h-- > 0;) {
        const HangingNode *hanging = &constraints->hanging[h];
        const double *own = shares->weights + (size_t)shares->row[hanging->node] * shares->class_count;
        for (int e = 0; e < 2; e++) {
            for (size_t c = 0; c < shares->class_count; c++)
                add_share(shares, hanging->end[e], (int32_t)c, 0.5 * own[c]);
        }
    }
}

/* Weights of the nodes where classes meet; hanging nodes and their ends get rows too. */
static int weigh(const MotionInput *input, const Motion *motion, const Recipes *recipes, Shares *shares)
{
    size_t nodes = (size_t)motion->node_count, rows = 0;
    shares->class_count = recipes->table.count;
    for (size_t n = 0; n < nodes; n++) shares->only[n] = -1;
    visit_corners(input, motion, recipes, shares, note_class);
    note_hanging(&motion->constraints, shares);
    for (size_t n = 0; n < nodes; n++) shares->row[n] = shares->only[n] == -2 ? (int32_t)rows++ : -1;
    for (int h = 0; h < motion->constraints.hanging_count; h++) {
        int32_t node = motion->constraints.hanging[h].node;
        if (shares->row[node] < 0) shares->row[node] = (int32_t)rows++;
    }
    shares->weights = memory_alloc(rows * shares->class_count + 1, sizeof *shares->weights);
    if (!shares->weights) return -1;
    visit_corners(input, motion, recipes, shares, add_share);
    add_hanging(&motion->constraints, shares);
    return 0;
}

/* The class of a node where several meet: the mean by mass (by count where there is no mass). */
static int32_t mixed_class(Recipes *recipes, const Shares *shares, int32_t row, bool *fits)
{
    const double *weights = shares->weights + (size_t)row * shares->class_count;
    double total = 0;
    for (size_t c = 0; c < shares->class_count; c++) total += weights[c];
    BodyClass mixed;
    body_class_clear(&mixed);
    for (size_t c = 0; c < shares->class_count && total > 0; c++) {
        if (weights[c] > 0 && !body_class_add(&mixed, &recipes->table.items[c], weights[c] / total)) *fits = false;
    }
    return class_table_find(&recipes->table, &mixed);
}

static int class_nodes(const MotionInput *input, Motion *motion, Recipes *recipes, Shares *shares,
                       Diagnostics *diagnostics)
{
    if (weigh(input, motion, recipes, shares)) return motion_no_memory(KEYWORD, diagnostics);
    bool fits = true;
    for (int n = 0; n < motion->node_count; n++) {
        /* Rigid bodies have a class as a whole; nodes that never move need none. */
        if (motion->fixed[n] || motion->node_body[n] != MOTION_DEFORMABLE) continue;
        int32_t found = shares->only[n];
        if (found == -1) found = input->node_mass && input->node_mass[n] > 0 ? recipes->everywhere : 0; /* of cables */
        if (found == -2) found = mixed_class(recipes, shares, shares->row[n], &fits);
        if (found < 0) return motion_no_memory(KEYWORD, diagnostics);
        motion->node_class[n] = found;
    }
    for (int h = 0; h < motion->constraints.hanging_count; h++)
        motion->node_class[motion->constraints.hanging[h].node] = 0;
    if (fits) return 0;
    class_report_full(KEYWORD, BILLOW_NO_SOURCE, diagnostics);
    return -1;
}

/* Mass-weighted damping of the airbags: a copy of each node's class with the bag in it. */
static int class_airbags(const MotionInput *input, Motion *motion, Recipes *recipes, Diagnostics *diagnostics)
{
    int twice = 0;
    for (int bag = 0; bag < input->airbag_count; bag++) {
        const AirbagNodes *airbag = &input->airbags[bag];
        if (airbag->mwd == 0) continue;
        for (int k = 0; k < airbag->node_count; k++) {
            int32_t node = airbag->node[k];
            if (motion->fixed[node] || motion->node_body[node] != MOTION_DEFORMABLE) continue;
            BodyClass with_bag;
            memcpy(&with_bag, &recipes->table.items[motion->node_class[node]], sizeof with_bag);
            if (with_bag.airbag >= 0) {
                twice += with_bag.airbag != bag;
                continue;
            }
            with_bag.airbag = bag;
            with_bag.airbag_damping = airbag->mwd;
            int32_t found = class_table_find(&recipes->table, &with_bag);
            if (found < 0) return motion_no_memory("*AIRBAG", diagnostics);
            motion->node_class[node] = found;
        }
    }
    if (twice > 0) {
        diagnostics_add(diagnostics, SEVERITY_WARNING, BILLOW_NO_SOURCE, "*AIRBAG",
                        "%d node(s) are on two bags with mass-weighted damping (MWD); the first bag's is taken", twice);
    }
    return 0;
}

/* A body of several parts or of a node set: the mean of its nodes' classes by their mass. */
static int32_t mixed_body_class(const MotionInput *input, Recipes *recipes, const Shares *shares, const RigidBody *body,
                                bool *fits)
{
    BodyClass mixed;
    double total = 0;
    body_class_clear(&mixed);
    for (int k = 0; k < body->node_count; k++) total += input->node_mass[body->node[k]];
    for (size_t c = 0; c <= shares->class_count && total > 0; c++) {
        double weight = 0; /* the last round is for nodes without shells */
        for (int k = 0; k < body->node_count; k++) {
            int32_t node = body->node[k], only = shares->only[node];
            double mass = input->node_mass[node], sum = 0;
            if (only == (c < shares->class_count ? (int32_t)c : -1)) weight += mass;
            if (only != -2 || c == shares->class_count) continue;
            const double *row = shares->weights + (size_t)shares->row[node] * shares->class_count;
            for (size_t i = 0; i < shares->class_count; i++) sum += row[i];
            if (sum > 0) weight += mass * row[c] / sum;
        }
        if (!(weight > 0)) continue;
        const BodyClass *class = c < shares->class_count ? &recipes->table.items[c] : &recipes->cards.everywhere;
        if (!body_class_add(&mixed, class, weight / total)) *fits = false;
    }
    return class_table_find(&recipes->table, &mixed);
}

static int class_bodies(const MotionInput *input, Motion *motion, Recipes *recipes, const Shares *shares,
                        Diagnostics *diagnostics)
{
    bool fits = true;
    for (int b = 0; b < motion->rigid_body_count; b++) {
        RigidBody *body = &motion->rigid_bodies[b];
        int32_t part = body->nodal ? -1 : id_map_find(&input->index->parts, body->part_id);
        int32_t found = part >= 0 && !(body->merged && input->node_mass)
                            ? recipes->class_of_part[part]
                            : mixed_body_class(input, recipes, shares, body, &fits);
        if (found < 0) return motion_no_memory(KEYWORD, diagnostics);
        body->body_class = found;
    }
    if (fits) return 0;
    class_report_full(KEYWORD, BILLOW_NO_SOURCE, diagnostics);
    return -1;
}

static bool anything_acts(const MotionInput *input)
{
    const Definitions *d = input->index->definitions;
    bool acts = d->body_loads.count > 0 || d->gravity_parts.count > 0 || d->dampings.count > 0;
    for (int bag = 0; bag < input->airbag_count; bag++) acts = acts || input->airbags[bag].mwd != 0;
    return acts;
}

/* Class 0 is there in every model. */
static int only_empty_class(Motion *motion, Diagnostics *diagnostics)
{
    motion->loads.classes = memory_alloc(1, sizeof *motion->loads.classes);
    if (!motion->loads.classes) return motion_no_memory(KEYWORD, diagnostics);
    body_class_clear(&motion->loads.classes[0]);
    motion->loads.class_count = 1;
    return 0;
}

int build_body_classes(const MotionInput *input, Motion *motion, Diagnostics *diagnostics)
{
    if (!anything_acts(input)) return only_empty_class(motion, diagnostics);
    size_t nodes = (size_t)motion->node_count, parts = input->index->definitions->parts.count;
    Recipes recipes = {0};
    Shares shares = {0};
    body_class_clear(&recipes.cards.everywhere);
    recipes.cards.of_part = memory_alloc(parts + 1, sizeof *recipes.cards.of_part);
    recipes.class_of_part = memory_alloc(parts + 1, sizeof *recipes.class_of_part);
    shares.only = memory_alloc(nodes + 1, sizeof *shares.only);
    shares.row = memory_alloc(nodes + 1, sizeof *shares.row);
    motion->node_class = memory_alloc(nodes + 1, sizeof *motion->node_class);
    int status = 0;
    if (!recipes.cards.of_part || !recipes.class_of_part || !shares.only || !shares.row || !motion->node_class) {
        status = motion_no_memory(KEYWORD, diagnostics);
    } else {
        for (size_t p = 0; p < parts; p++) body_class_clear(&recipes.cards.of_part[p]);
        status = class_cards_read(input, &recipes.cards, diagnostics);
        if (status == 0) status = class_parts(input, &recipes, diagnostics);
        if (status == 0) status = class_nodes(input, motion, &recipes, &shares, diagnostics);
        if (status == 0) status = class_airbags(input, motion, &recipes, diagnostics);
        if (status == 0) status = class_bodies(input, motion, &recipes, &shares, diagnostics);
    }
    motion->loads.classes = recipes.table.items;
    motion->loads.class_count = (int)recipes.table.count;
    class_table_close(&recipes.table);
    memory_free(recipes.cards.of_part);
    memory_free(recipes.class_of_part);
    memory_free(shares.only);
    memory_free(shares.row);
    memory_free(shares.weights);
    if (motion->loads.class_count == 1) { /* cards without effect */
        memory_free(motion->node_class);
        motion->node_class = NULL;
    }
    return status;
}
