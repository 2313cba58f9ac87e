/* Reference geometries of the shells: which corners, from when on, with which step. */
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/memory.h"
#include "solver/reference_order.h"
#include "solver/reference_table.h"

enum { LISTED = 200 }; /* messages of one kind: the first ones tell what is wrong */

static const char NODES[] = "*AIRBAG_REFERENCE_GEOMETRY", SHELLS[] = "*AIRBAG_SHELL_REFERENCE_GEOMETRY";

/* What is being built. */
typedef struct ReferenceBuild {
    Builder *b;
    ReferenceTable table;
    double birth; /* of all blocks with BIRTH: the last one read */
    ReferenceOrder order;
    int *line; /* of each shell its last line in the tables of panels, from 1; 0 none (shell_count) */
} ReferenceBuild;

static void report(Builder *b, Source source, const char *keyword, int *listed, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

static void report(Builder *b, Source source, const char *keyword, int *listed, const char *format, ...)
{
    if (++*listed > LISTED) return;
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    diagnostics_add(b->diagnostics, SEVERITY_ERROR, source, keyword, "%s", text);
}

/* Nodes that the deck does not define, origins too; nodes that are placed twice. */
static int check_nodes(ReferenceBuild *r)
{
    const Definitions *d = r->b->definitions;
    const ReferenceTable *table = &r->table;
    int missing = 0, twice = 0;
    for (size_t i = 0; i < d->reference_nodes.count; i++) {
        const ReferenceNodeDefinition *record = &d->reference_nodes.items[i];
        int32_t node = id_map_find(&table->nodes, record->id);
        if (node < 0) {
            report(r->b, record->source, NODES, &missing,
                   "node NID = %d is not defined under *NODE; add it there or remove the line", record->id);
            continue;
        }
        int32_t last = table->record[node];
        if (last == (int32_t)i || memcmp(table->x + 3 * i, table->x + 3 * (ptrdiff_t)last, 3 * sizeof(double)) == 0)
            continue;
        if (twice++ == 0)
            diagnostics_add(r->b->diagnostics, SEVERITY_WARNING, record->source, NODES,
                            "node NID = %d is placed again in another place, which counts (line %d)", record->id,
                            d->reference_nodes.items[last].source.line);
    }
    for (size_t i = 0; i < d->reference_blocks.count; i++) {
        const ReferenceBlockDefinition *block = &d->reference_blocks.items[i];
        int id;
        if (block->nid == 0 || reference_table_origin(table, block, &id) >= 0) continue;
        report(r->b, block->id_source, block->is_shell ? SHELLS : NODES, &missing,
               "the origin %s = %d of the scale factors is not defined under *NODE", block->is_shell ? "NID" : "NIDO",
               block->nid);
    }
    return missing ? -1 : 0;
}

/* The birth of a shell: RGBRTH goes before the card's. */
static double shell_birth(const Builder *b, int shell, double birth)
{
    const PartRecord *part = &b->parts[b->records[shell].part];
    return part->reference_birth != 0.0 ? part->reference_birth : birth;
}

/* Shells with a corner in a block of nodes. */
static void take_nodes(ReferenceBuild *r)
{
    Builder *b = r->b;
    const Definitions *d = b->definitions;
    for (int i = 0; i < b->shell_count; i++) {
        const ShellRecord *record = &b->records[i];
        ShellReference *reference = &b->references[i];
        double birth = 0.0;
        for (int a = 0; a < record->corner_count; a++) {
            int32_t found = r->table.record[record->node[a]];
            reference_table_node(&r->table, record->node[a], reference->x + 3 * a);
            if (found < 0) continue;
            const ReferenceBlockDefinition *block = &d->reference_blocks.items[r->table.block[found]];
            if (!reference->given) reference->source = d->reference_nodes.items[found].source;
            reference->given = true;
            reference->rdt |= block->rdt;
            if (block->has_birth && r->birth > birth) birth = r->birth;
        }
        reference->keyword = NODES;
        reference->birth = shell_birth(b, i, birth);
    }
}

/* Drops corners that repeat their neighbour, as *ELEMENT_SHELL does; returns how many are left. */
static int distinct_corners(const int node[4], int corner[4])
{
    int count = node[3] == 0 ? 3 : 4;
    memcpy(corner, node, 4 * sizeof *corner);
    for (int i = 0; i < count; i++) {
        if (count < 3 || corner[i] != corner[(i + 1) % count]) continue;
        const int drop = i + 1 < count ? i + 1 : i;
        for (int j = drop; j + 1 < count; j++) corner[j] = corner[j + 1];
        count--;
        i--;
    }
    return count;
}

/* One shell of a table of panels; its corners' nodes into corner. Returns the shell's record, or -1 after an error. */
static int match_shell(ReferenceBuild *r, const ReferenceShellDefinition *card, int32_t corner[4], int *listed)
{
    Builder *b = r->b;
    int shell = id_map_find(&b->index.shells, card->id), id[4];
    if (shell < 0 || shell >= b->shell_count) {
        report(b, card->source, SHELLS, listed,
               "element EID = %d is not defined under *ELEMENT_SHELL; correct EID or remove the line", card->id);
        return -1;
    }
    int count = distinct_corners(card->node, id), corners = b->records[shell].corner_count;
    if (count != corners) {
        report(b, card->source, SHELLS, listed,
               "element %d has %d different corners here, but %d under *ELEMENT_SHELL; both must have the same",
               card->id, count, corners);
        return -1;
    }
    for (int a = 0; a < count; a++) {
        corner[a] = id_map_find(&b->index.nodes, id[a]);
        if (corner[a] >= 0) continue;
        report(b, card->source, SHELLS, listed, "element %d names node %d, which is not defined under *NODE", card->id,
               id[a]);
        return -1;
    }
    return shell;
}

/* The shell's place in the reference, from a matched line of a table. */
static void place_shell(ReferenceBuild *r, const ReferenceBlockDefinition *block, const ReferenceShellDefinition *card,
                        const PanelShell *panel)
{
    ShellReference *reference = &r->b->references[panel->shell];
    for (int a = 0; a < panel->corner_count; a++) {
        reference_table_node(&r->table, panel->corner[a], reference->x + 3 * a);
        reference_table_scale(&r->table, block, reference->x + 3 * a);
    }
    reference->given = true;
    reference->rdt = block->rdt;
    reference->keyword = SHELLS;
    reference->source = card->source;
    reference->birth = shell_birth(r->b, panel->shell, 0.0);
}

/* All lines of the tables against the mesh. */
static int match_shells(ReferenceBuild *r, PanelShell *panels, int *listed)
{
    Builder *b = r->b;
    const Definitions *d = b->definitions;
    int status = 0;
    for (size_t i = 0; i < d->reference_shells.count; i++) {
        PanelShell *panel = &panels[i];
        panel->shell = match_shell(r, &d->reference_shells.items[i], panel->corner, listed);
        if (panel->shell < 0) {
            status = -1;
            continue;
        }
        panel->corner_count = b->records[panel->shell].corner_count;
        panel->node = b->records[panel->shell].node;
    }
    return status;
}

/* Order and winding of all shells, then of each; a shell that stands in two lines. */
static int check_order(ReferenceBuild *r, const PanelShell *panels, int *listed)
{
    Builder *b = r->b;
    const Definitions *d = b->definitions;
    const int count = (int)d->reference_shells.count;
    int status = 0, first = 0, twice = 0;
    CornerOrder all = reference_order_vote(&r->order, panels, count);
    while (first < count && panels[first].shell < 0) first++;
    if (all != CORNERS_FIT) {
        report(b, d->reference_shells.items[first].source, SHELLS, listed,
               "the corners of the elements %s than under *ELEMENT_SHELL, as the nodes that they have in common show; "
               "write N1 to N4 in the same order and winding there and here",
               all == CORNERS_TURNED ? "begin with others" : "go round the other way");
        return -1;
    }
    for (int i = 0; i < count; i++) {
        if (panels[i].shell < 0) continue;
        const ReferenceShellDefinition *card = &d->reference_shells.items[i];
        const int before = r->line[panels[i].shell] - 1;
        r->line[panels[i].shell] = i + 1;
        if (before >= 0 && memcmp(panels[before].corner, panels[i].corner, sizeof panels[i].corner) != 0 &&
            twice++ == 0)
            diagnostics_add(b->diagnostics, SEVERITY_WARNING, card->source, SHELLS,
                            "element EID = %d stands here again with other nodes, which count (line %d)", card->id,
                            d->reference_shells.items[before].source.line);
        if (!reference_order_differs(&r->order, &panels[i])) continue;
        report(b, card->source, SHELLS, listed,
               "element %d: N1 to N4 are in another order than under *ELEMENT_SHELL, as its neighbours show; the "
               "order and winding must be the same",
               card->id);
        status = -1;
    }
    return status;
}

/* A part of which only some shells are in a table of panels: an element was forgotten. */
static int check_coverage(ReferenceBuild *r, int *listed)
{
    Builder *b = r->b;
    int status = 0;
    for (int p = 0; p < b->model->part_count; p++) {
        const ShellReference *first = NULL;
        int missing = -1, without = 0, with = 0;
        for (int32_t k = b->index.part_shell_start[p]; k < b->index.part_shell_start[p + 1]; k++) {
            const ShellReference *reference = &b->references[b->index.part_shell[k]];
            bool panel = reference->given && reference->keyword == SHELLS;
            if (panel && !first) first = reference;
            if (!reference->given && missing < 0) missing = b->index.part_shell[k];
            without += !reference->given;
            with += panel;
        }
        if (!first || missing < 0) continue;
        report(
            b, first->source, SHELLS, listed,
            "part %d has %d elements here, but %d of its elements have no reference, the first is %d; add them, with "
            "their own nodes where they keep their place",
            b->model->parts[p].id, with, without, b->definitions->shells.items[missing].id);
        status = -1;
    }
    return status;
}

static int take_shells(ReferenceBuild *r)
{
    Builder *b = r->b;
    const Definitions *d = b->definitions;
    if (d->reference_shells.count == 0) return 0;
    PanelShell *panels = memory_alloc(d->reference_shells.count, sizeof *panels);
    r->line = memory_alloc((size_t)b->shell_count + 1, sizeof *r->line);
    int status = panels && r->line && !reference_order_create(b->node_count, &r->order) ? 0 : -1, listed = 0;
    if (!status) {
        if (match_shells(r, panels, &listed)) status = -1;
        if (check_order(r, panels, &listed)) status = -1;
        for (size_t i = 0; i < d->reference_blocks.count; i++) {
            const ReferenceBlockDefinition *block = &d->reference_blocks.items[i];
            for (size_t k = block->first; block->is_shell && k < block->first + block->count; k++)
                if (panels[k].shell >= 0) place_shell(r, block, &d->reference_shells.items[k], &panels[k]);
        }
    }
    memory_free(panels);
    if (!status && check_coverage(r, &listed)) status = -1;
    return status;
}

/* Elements with some corners among the nodes of a block and some not: a node was forgotten, perhaps. */
static void warn_of_partial_shells(const ReferenceBuild *r)
{
    const Builder *b = r->b;
    int count = 0, first = -1, absent = -1;
    for (int i = 0; i < b->shell_count; i++) {
        const ShellRecord *record = &b->records[i];
        if (!b->references[i].given || b->references[i].keyword != NODES) continue;
        for (int a = 0; a < record->corner_count; a++) {
            if (r->table.record[record->node[a]] >= 0) continue;
            if (count++ == 0) {
                first = i;
                absent = record->node[a];
            }
            break;
        }
    }
    if (count == 0) return;
    diagnostics_add(b->diagnostics, SEVERITY_WARNING, b->references[first].source, NODES,
                    "%d elements have some of their nodes here and some not, which keep their place under *NODE: the "
                    "first is element %d with node %d; add the nodes if they were forgotten",
                    count, b->definitions->shells.items[first].id, b->definitions->nodes.items[absent].id);
}

/* References of parts whose material has none: said once a part, then left out. */
static void drop_unused(Builder *b)
{
    for (int p = 0; p < b->model->part_count; p++) {
        int32_t start = b->index.part_shell_start[p], end = b->index.part_shell_start[p + 1];
        bool said = b->parts[p].law == LAW_SURFACE || b->parts[p].has_reference;
        for (int32_t k = start; k < end; k++) {
            ShellReference *reference = &b->references[b->index.part_shell[k]];
            if (!reference->given || b->parts[p].has_reference) continue;
            bool moved = false;
            const ShellRecord *record = &b->records[b->index.part_shell[k]];
            for (int a = 0; a < record->corner_count; a++)
                for (int i = 0; i < 3; i++) moved |= reference->x[3 * a + i] != b->x[3 * record->node[a] + i];
            if (moved && !said)
                diagnostics_add(b->diagnostics, SEVERITY_WARNING, reference->source, reference->keyword,
                                "part %d is not of *MAT_FABRIC: its elements keep the geometry of the mesh",
                                b->model->parts[p].id);
            said |= moved;
            reference->given = false;
        }
    }
}

int build_reference(Builder *b)
{
    const Definitions *d = b->definitions;
    if (d->reference_blocks.count == 0) return 0;
    ReferenceBuild r = {.b = b};
    b->references = memory_alloc((size_t)b->shell_count + 1, sizeof *b->references);
    int status = b->references && !reference_table_build(d, &r.table) ? 0 : -1;
    if (!status) {
        for (size_t i = 0; i < d->reference_blocks.count; i++)
            if (d->reference_blocks.items[i].has_birth) r.birth = d->reference_blocks.items[i].birth;
        status = check_nodes(&r);
        take_nodes(&r);
        if (take_shells(&r)) status = -1;
        drop_unused(b);
        warn_of_partial_shells(&r);
        if (build_reference_mass(b)) status = -1;
    }
    reference_table_free(&r.table);
    reference_order_free(&r.order);
    memory_free(r.line);
    return status;
}

int check_reference(Builder *b)
{
    if (b->definitions->reference_blocks.count == 0) return 0;
    ReferenceBuild r = {.b = b};
    int status = reference_table_build(b->definitions, &r.table);
    if (!status) status = check_nodes(&r);
    reference_table_free(&r.table);
    return status;
}
