/* billow fold: from a flat deck and a file of folds to the folded deck. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contact/mesh_crossing.h"
#include "fold/fold.h"
#include "io/deck_file.h"
#include "io/read.h"
#include "solver/billow.h"
#include "solver/id_map.h"
#include "solver/memory.h"

/* Flatness of a flat bag: heights of its nodes over its size. */
#define FLAT 1e-6

typedef struct Command {
    const char *deck, *folds, *output;
    Diagnostics diagnostics;
    Definitions definitions;
    FoldPlan plan;
    FoldBag bag;
    int *node_id, *shell_id; /* of the bag's nodes and facets */
    IdMap nodes;
} Command;

#define REFUSE(command, source, keyword, ...)                                                                          \
    diagnostics_add(&(command)->diagnostics, SEVERITY_ERROR, source, keyword, __VA_ARGS__)

static int refuse_memory(Command *command)
{
    diagnostics_add(&command->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                    "not enough memory to fold this deck");
    return -1;
}

static bool holds(const int *items, size_t count, int id)
{
    for (size_t i = 0; i < count; i++)
        if (items[i] == id) return true;
    return false;
}

/* +1 upper, -1 lower, 0 none. */
static int panel_of(const FoldPlan *plan, int part)
{
    if (holds(plan->upper.items, plan->upper.count, part)) return 1;
    return holds(plan->lower.items, plan->lower.count, part) ? -1 : 0;
}

static void check_part(Command *command, int id, const char *panel)
{
    const Definitions *d = &command->definitions;
    if (holds(command->plan.upper.items, command->plan.upper.count, id) &&
        holds(command->plan.lower.items, command->plan.lower.count, id))
        REFUSE(command, BILLOW_NO_SOURCE, NULL, "%s: part %d is named as upper and as lower", command->folds, id);
    for (size_t i = 0; i < d->shells.count; i++)
        if (d->shells.items[i].part == id) return;
    REFUSE(command, BILLOW_NO_SOURCE, NULL, "%s: %s: %s has no shells of part %d", command->folds, panel, command->deck,
           id);
}

static bool is_rigid(const Definitions *d, int part)
{
    for (size_t p = 0; p < d->parts.count; p++) {
        if (d->parts.items[p].id != part) continue;
        for (size_t m = 0; m < d->materials.count; m++)
            if (d->materials.items[m].id == d->parts.items[p].material)
                return d->materials.items[m].kind == MATERIAL_RIGID;
    }
    return false;
}

/* Marks the nodes of the panels (1 upper, 2 lower, 4 of other shells) and counts facets; errors for missing nodes. */
static void mark_nodes(Command *command, unsigned char *mark)
{
    const Definitions *d = &command->definitions;
    for (size_t i = 0; i < d->shells.count; i++) {
        const ShellDefinition *shell = &d->shells.items[i];
        const int panel = panel_of(&command->plan, shell->part);
        if (panel) command->bag.facet_count++;
        for (int c = 0; c < 4; c++) {
            const int32_t node = id_map_find(&command->nodes, shell->node[c]);
            if (node >= 0)
                mark[node] |= (unsigned char)(panel > 0 ? 1 : panel < 0 ? 2 : 4);
            else
                REFUSE(command, shell->source, "*ELEMENT_SHELL", "element %d names node %d, which is not defined",
                       shell->id, shell->node[c]);
        }
    }
    for (size_t n = 0; n < d->nodes.count; n++) {
        if ((mark[n] & 3) == 0) continue;
        command->bag.node_count++;
        if ((mark[n] & 4) != 0)
            REFUSE(command, d->nodes.items[n].source, "*NODE",
                   "node %d belongs to a panel and to a shell of a part that is neither upper nor lower",
                   d->nodes.items[n].id);
        if (d->nodes.items[n].source.file != 0)
            REFUSE(command, d->nodes.items[n].source, "*NODE",
                   "node %d stands in an included file; billow fold needs the nodes in the main deck",
                   d->nodes.items[n].id);
    }
}

static int fill_bag(Command *command, const unsigned char *mark)
{
    FoldBag *bag = &command->bag;
    const Definitions *d = &command->definitions;
    int32_t *place = memory_alloc(d->nodes.count + 1, sizeof *place);
    bag->flat = memory_alloc((size_t)bag->node_count + 1, 3 * sizeof *bag->flat);
    bag->panel = memory_alloc((size_t)bag->node_count + 1, 1);
    bag->facet = memory_alloc((size_t)bag->facet_count + 1, 4 * sizeof *bag->facet);
    bag->rigid = memory_alloc((size_t)bag->facet_count + 1, 1);
    command->node_id = memory_alloc((size_t)bag->node_count + 1, sizeof *command->node_id);
    command->shell_id = memory_alloc((size_t)bag->facet_count + 1, sizeof *command->shell_id);
    const bool complete =
        place && bag->flat && bag->panel && bag->facet && bag->rigid && command->node_id && command->shell_id;
    int32_t count = 0;
    for (size_t n = 0; complete && n < d->nodes.count; n++) {
        if ((mark[n] & 3) == 0) continue;
        for (int k = 0; k < 3; k++) bag->flat[3 * (ptrdiff_t)count + k] = d->nodes.items[n].x[k];
        bag->panel[count] = (signed char)((mark[n] & 3) == 3 ? 0 : (mark[n] & 1) ? 1 : -1);
        command->node_id[count] = d->nodes.items[n].id;
        place[n] = count++;
    }
    int facet = 0;
    for (size_t i = 0; complete && i < d->shells.count; i++) {
        const ShellDefinition *shell = &d->shells.items[i];
        if (!panel_of(&command->plan, shell->part)) continue;
        bag->rigid[facet] = is_rigid(d, shell->part);
        command->shell_id[facet] = shell->id;
        for (int c = 0; c < 4; c++)
            bag->facet[4 * (ptrdiff_t)facet + c] = place[id_map_find(&command->nodes, shell->node[c])];
        facet++;
    }
    memory_free(place);
    return complete ? 0 : -1;
}

/* All shells in the plane z = const and none without area. */
static void check_flat(Command *command)
{
    const FoldBag *bag = &command->bag;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    int seams = 0;
    for (int n = 0; n < bag->node_count; n++) {
        seams += bag->panel[n] == 0;
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], bag->flat[3 * (ptrdiff_t)n + k]);
            high[k] = fmax(high[k], bag->flat[3 * (ptrdiff_t)n + k]);
        }
    }
    if (!(high[2] - low[2] <= FLAT * fmax(high[0] - low[0], high[1] - low[1])))
        REFUSE(command, BILLOW_NO_SOURCE, NULL,
               "%s: the panels are not flat: z is from %.6g to %.6g; billow fold takes a bag in a plane of constant z",
               command->deck, low[2], high[2]);
    if (seams == 0)
        REFUSE(command, BILLOW_NO_SOURCE, NULL, "%s: the upper and the lower panel share no node, so there is no seam",
               command->deck);
}

static int make_bag(Command *command)
{
    const Definitions *d = &command->definitions;
    for (size_t i = 0; i < command->plan.upper.count; i++) check_part(command, command->plan.upper.items[i], "upper");
    for (size_t i = 0; i < command->plan.lower.count; i++) check_part(command, command->plan.lower.items[i], "lower");
    if (command->diagnostics.errors) return -1;
    int32_t duplicate;
    if (id_map_build(&command->nodes, &d->nodes.items[0].id, d->nodes.count, sizeof *d->nodes.items, &duplicate))
        return refuse_memory(command);
    unsigned char *mark = memory_alloc(d->nodes.count + 1, 1);
    if (!mark) return refuse_memory(command);
    mark_nodes(command, mark);
    const int status = command->diagnostics.errors ? -1 : fill_bag(command, mark) ? refuse_memory(command) : 0;
    memory_free(mark);
    if (status) return -1;
    check_flat(command);
    if (command->diagnostics.errors) return -1;
    return fold_bag_open(&command->bag, &command->plan) ? refuse_memory(command) : 0;
}

/* Reference geometries of the deck would be at odds with the one to be written. */
static int check_text(Command *command)
{
    DeckFile file = {0};
    bool no_memory;
    const char *wrong = deck_file_read(command->deck, &file, &no_memory);
    if (wrong) {
        REFUSE(command, BILLOW_NO_SOURCE, NULL, "%s: %s", command->deck, wrong);
        return -1;
    }
    int number = 0;
    for (const char *line = file.text; line && *line; line = strchr(line, '\n'), line = line ? line + 1 : NULL) {
        number++;
        if (strncmp(line, "*AIRBAG_REFERENCE_GEOMETRY", 26) == 0 || strncmp(line, "*AIRBAG_SHELL_REFERENCE", 23) == 0)
            REFUSE(command, ((Source){0, number}), "*AIRBAG_REFERENCE_GEOMETRY",
                   "the deck has a reference geometry already; billow fold takes the flat bag itself");
    }
    memory_free(file.text);
    return command->diagnostics.errors ? -1 : 0;
}

static int make_folds(Command *command)
{
    char problem[FOLD_TEXT];
    for (size_t i = 0; i < command->plan.folds.count; i++) {
        const Fold *fold = &command->plan.folds.items[i];
        if (fold_make(&command->bag, &command->plan, fold, problem) == 0) continue;
        REFUSE(command, fold->source, NULL, "this fold cannot be made: %s", problem);
        return -1;
    }
    return 0;
}

/* Lengths, areas and intersections; the first two are printed. */
static int judge(Command *command)
{
    const FoldBag *bag = &command->bag;
    const Source source = command->plan.folds.items[0].source;
    FoldMeasure measure;
    MeshCrossings crossings;
    fold_measure(bag, &measure);
    if (mesh_find_crossings(bag->facet_count, bag->facet, bag->x, NULL, &crossings)) return refuse_memory(command);
    printf("folded by %d line%s: longest edge change %+.2f %% and %+.2f %%, area %+.3f %% (worst shell %+.2f %%), "
           "intersections %d\n",
           bag->crease_count, bag->crease_count == 1 ? "" : "s", 100 * measure.stretch, -100 * measure.shrink,
           100 * (measure.area / measure.flat_area - 1), 100 * measure.area_change, crossings.count);
    const double worst = fmax(measure.stretch, measure.shrink);
    if (worst > command->plan.limit) {
        const int edge = measure.stretch > measure.shrink ? measure.stretched_edge : measure.shrunk_edge;
        REFUSE(
            command, source, NULL,
            "the edge between nodes %d and %d changes its length by %.1f %%, more than the limit of %.1f %%; make the "
            "gap smaller or the spread larger, or raise limit",
            command->node_id[bag->edge[2 * (ptrdiff_t)edge]], command->node_id[bag->edge[2 * (ptrdiff_t)edge + 1]],
            100 * worst, 100 * command->plan.limit);
    }
    if (crossings.count > 0)
        REFUSE(command, source, NULL,
               "%d pairs of shells go through each other, the deepest %d and %d at (%.6g, %.6g, %.6g); make the gap "
               "larger, the mesh finer or move the lines",
               crossings.count, command->shell_id[crossings.facet[0]], command->shell_id[crossings.facet[1]],
               crossings.place[0], crossings.place[1], crossings.place[2]);
    return command->diagnostics.errors ? -1 : 0;
}

static void write_output(Command *command)
{
    char name[FOLD_TEXT], problem[FOLD_TEXT];
    const char *output = command->output;
    if (!output) {
        const char *slash = strrchr(command->deck, '/'), *stem = slash ? slash + 1 : command->deck;
        const char *dot = strrchr(stem, '.');
        snprintf(name, sizeof name, "%.*s.folded.k", (int)(dot && dot > stem ? dot - stem : (ptrdiff_t)strlen(stem)),
                 stem);
        output = name;
    }
    if (strcmp(output, command->deck) == 0) {
        REFUSE(command, BILLOW_NO_SOURCE, NULL, "the output %s is the deck itself; give another name with -o", output);
        return;
    }
    if (fold_write_deck(command->deck, output, &command->definitions, &command->bag, command->node_id, problem))
        diagnostics_add(&command->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "%s", problem);
    else
        printf("%s: written\n", output);
}

static void fold(Command *command)
{
    if (deck_read(command->deck, &command->definitions, &command->diagnostics)) return;
    if (fold_read(command->folds, &command->plan, &command->diagnostics)) return;
    if (check_text(command) || make_bag(command) || make_folds(command) || judge(command)) return;
    write_output(command);
}

int fold_deck(const char *deck, const char *folds, const char *output)
{
    Command command = {.deck = deck, .folds = folds, .output = output};
    fold(&command);
    diagnostics_print(&command.diagnostics, SEVERITY_WARNING, stderr);
    const int code = diagnostics_exit_code(&command.diagnostics);
    memory_free(command.node_id);
    memory_free(command.shell_id);
    id_map_free(&command.nodes);
    fold_bag_free(&command.bag);
    fold_plan_free(&command.plan);
    definitions_free(&command.definitions);
    diagnostics_free(&command.diagnostics);
    return code;
}
