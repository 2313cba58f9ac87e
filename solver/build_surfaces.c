/* Surfaces under pressure: facets of the airbags and of segment loads -> orientation, caps, pressure sets. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "solver/builder.h"
#include "solver/facet_map.h"
#include "solver/memory.h"

/* Facets of one pressure source: record indices and windings. */
typedef struct FacetList {
    int32_t *record; /* (count) */
    int32_t *node;   /* (count x 4), as the source winds them */
    int *sign;       /* winding relative to the record, then with the surface's turns */
    size_t count, record_capacity, node_capacity, sign_capacity;
} FacetList;

static void facets_free(FacetList *list)
{
    memory_free(list->record);
    memory_free(list->node);
    memory_free(list->sign);
    *list = (FacetList){0};
}

static int facets_add(FacetList *list, int32_t record, const int32_t node[4], int sign)
{
    if (memory_reserve((void **)&list->record, &list->record_capacity, list->count + 1, sizeof *list->record) ||
        memory_reserve((void **)&list->node, &list->node_capacity, 4 * (list->count + 1), sizeof *list->node) ||
        memory_reserve((void **)&list->sign, &list->sign_capacity, list->count + 1, sizeof *list->sign))
        return -1;
    list->record[list->count] = record;
    memcpy(list->node + 4 * list->count, node, 4 * sizeof *node);
    list->sign[list->count++] = sign;
    return 0;
}

/* The record under a segment: a shell with these nodes, or a new bare facet. */
static int facets_add_segment(Builder *b, FacetMap *map, FacetList *list, const int32_t node[4])
{
    int sign = 1;
    int32_t record = facet_map_find(map, node, &sign);
    if (record < 0) {
        if (memory_reserve((void **)&b->records, &b->record_capacity, (size_t)b->record_count + 1, sizeof *b->records))
            return -1;
        record = b->record_count++;
        ShellRecord *bare = &b->records[record];
        *bare = (ShellRecord){.part = -1,
                              .corner_count = node[3] == node[2] ? 3 : 4,
                              .law = LAW_SURFACE,
                              .pressure_set = -1,
                              .orientation = 1};
        bare->kind = bare->corner_count == 3 ? ELEMENT_TRIANGLE : ELEMENT_QUAD_FULL;
        memcpy(bare->node, node, sizeof bare->node);
        sign = 1;
    }
    return facets_add(list, record, node, sign);
}

static int airbag_facets(Builder *b, FacetMap *map, const AirbagDefinition *bag, FacetList *list)
{
    IndexList set = {0};
    int status;
    if (bag->sidtyp == 0) {
        status = sets_resolve_segments(&b->index, bag->sid, bag->card1, "*AIRBAG", &set, b->diagnostics);
        for (size_t i = 0; !status && i < set.count; i += 4) status = facets_add_segment(b, map, list, set.items + i);
    } else {
        status = sets_resolve_parts(&b->index, bag->sid, bag->card1, "*AIRBAG", &set, b->diagnostics);
        for (size_t i = 0; !status && i < set.count; i++) {
            int32_t part = set.items[i];
            for (int32_t k = b->index.part_shell_start[part]; !status && k < b->index.part_shell_start[part + 1]; k++) {
                int32_t shell = b->index.part_shell[k];
                status = facets_add(list, shell, b->records[shell].node, 1);
            }
        }
    }
    if (!status && list->count == 0) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, bag->card1, "*AIRBAG",
                        "set SID = %d holds no shells or segments, so the bag has no surface", bag->sid);
        status = -1;
    }
    index_list_free(&set);
    return status;
}

static int add_source(Builder *b, int32_t record, int source, int sign, bool push)
{
    ShellRecord *r = &b->records[record];
    if (r->source_count == 4) {
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "more than four airbags and pressure loads act on element %d",
                        record < b->shell_count ? b->definitions->shells.items[record].id : 0);
        return -1;
    }
    r->source[r->source_count] = source;
    r->push[r->source_count] = push;
    r->sign[r->source_count++] = sign;
    return 0;
}

/* EXCP = 1 of *AIRBAG_INTERACTION: the part between two bags feels the pressure of neither. */
static bool is_excluded(const Builder *b, const AirbagDefinition *bag, int part_id)
{
    for (size_t i = 0; bag->id != 0 && i < b->definitions->interactions.count; i++) {
        const InteractionDefinition *c = &b->definitions->interactions.items[i];
        if (c->excp != 0 && abs(c->pid) == part_id && (c->ab1 == bag->id || c->ab2 == bag->id)) return true;
    }
    return false;
}

/* Shells of *MAT_NULL in a bag with NONULL, and excluded partitions, bound a bag but do not feel its pressure. */
static bool feels_pressure(const Builder *b, const AirbagDefinition *bag, const ShellRecord *r)
{
    if (r->part < 0) return true;
    if (is_excluded(b, bag, b->model->parts[r->part].id)) return false;
    if (bag->nonull == 0 || b->parts[r->part].material < 0) return true;
    return b->definitions->materials.items[b->parts[r->part].material].kind != MATERIAL_NULL;
}

/* Orients and closes the surface of one bag; its sources are set on the records. */
static int close_bag(Builder *b, int airbag, FacetList *list)
{
    const AirbagDefinition *definition = &b->definitions->airbags.items[airbag];
    char name[64];
    snprintf(name, sizeof name, "airbag %d", definition->id ? definition->id : airbag + 1);
    int *turn = memory_alloc(list->count, sizeof *turn), *id = memory_alloc(list->count, sizeof *id);
    int *node_id = memory_alloc((size_t)b->node_count, sizeof *node_id);
    int status = turn && id && node_id ? 0 : -1;
    for (int i = 0; !status && i < b->node_count; i++) node_id[i] = b->definitions->nodes.items[i].id;
    for (size_t i = 0; !status && i < list->count; i++)
        id[i] = list->record[i] < b->shell_count ? b->definitions->shells.items[list->record[i]].id : (int)i + 1;
    SurfaceInput input = {.facet_count = (int)list->count,
                          .node = list->node,
                          .facet_id = id,
                          .x = b->x,
                          .node_id = node_id,
                          .name = name,
                          .source = definition->source,
                          .keyword = "*AIRBAG"};
    if (!status) status = surface_close(&input, turn, &b->closures[airbag], b->diagnostics);
    for (size_t i = 0; !status && i < list->count; i++)
        if (turn[i] != 0) /* 0: inside */
            status = add_source(b, list->record[i], airbag, list->sign[i] * turn[i],
                                feels_pressure(b, definition, &b->records[list->record[i]]));
    memory_free(turn);
    memory_free(id);
    memory_free(node_id);
    return status;
}

static int compare_int32(const void *a, const void *b)
{
    int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
    return (x > y) - (x < y);
}

/* Nodes and parts on the bag's surface, each once. */
static int list_bag(Builder *b, Airbag *bag, const FacetList *list)
{
    size_t corners = 4 * list->count, count = 0;
    int32_t *corner = memory_alloc(corners + 1, sizeof *corner);
    if (!corner) return -1;
    memcpy(corner, list->node, corners * sizeof *corner);
    qsort(corner, corners, sizeof *corner, compare_int32);
    for (size_t i = 0; i < corners; i++)
        if (i == 0 || corner[i] != corner[i - 1]) corner[count++] = corner[i];
    bag->node = builder_alloc(b, count + 1, sizeof *bag->node);
    bag->part = builder_alloc(b, (size_t)b->model->part_count + 1, sizeof *bag->part);
    if (bag->node) memcpy(bag->node, corner, count * sizeof *corner);
    bag->node_count = (int)count;
    memory_free(corner);
    if (!bag->node || !bag->part) return -1;
    for (int p = 0; p < b->model->part_count; p++) {
        bool on = false;
        for (size_t i = 0; !on && i < list->count; i++) on = b->records[list->record[i]].part == p;
        if (on) bag->part[bag->part_count++] = p;
    }
    return 0;
}

/* Equal pressures on equal orientation make one set: the orientation of the first source is the record's. */
static int assign_pressure_sets(Builder *b)
{
    Model *model = b->model;
    size_t capacity = 0;
    PressureSet *sets = NULL;
    int status = 0;
    for (int i = 0; !status && i < b->record_count; i++) {
        ShellRecord *r = &b->records[i];
        if (r->source_count == 0) continue;
        r->orientation = r->sign[0];
        PressureSet wanted = {.count = r->source_count};
        for (int s = 0; s < r->source_count; s++) {
            wanted.source[s] = r->source[s];
            wanted.sign[s] = r->sign[s] * r->orientation;
            wanted.push[s] = wanted.sign[s] * r->push[s];
        }
        int found = -1;
        for (int k = 0; k < model->pressure_set_count && found < 0; k++)
            if (memcmp(&sets[k], &wanted, sizeof wanted) == 0) found = k;
        if (found < 0) {
            status = memory_reserve((void **)&sets, &capacity, (size_t)model->pressure_set_count + 1, sizeof *sets);
            if (status) break;
            found = model->pressure_set_count++;
            sets[found] = wanted;
        }
        r->pressure_set = found;
    }
    model->pressure_sets = sets;
    return builder_adopt(b, sets) || status ? -1 : 0;
}

/* Segment loads push against their segment's normal: the source is in front of the winding. */
static int load_facets(Builder *b, FacetMap *map)
{
    const Motion *motion = &b->motion;
    FacetList list = {0};
    int status = 0;
    for (int i = 0; !status && i < motion->segment_count; i++) {
        status = facets_add_segment(b, map, &list, motion->segment_node + 4 * i);
        if (!status)
            status =
                add_source(b, list.record[i], b->model->airbag_count + motion->segment_load[i], -list.sign[i], true);
    }
    facets_free(&list);
    return status;
}

static int find_airbag_surfaces(Builder *b, FacetMap *map)
{
    const Definitions *d = b->definitions;
    int count = (int)d->airbags.count, status = 0;
    b->model->airbag_count = count;
    b->model->airbags = builder_alloc(b, (size_t)count + 1, sizeof *b->model->airbags);
    b->closures = memory_alloc((size_t)count + 1, sizeof *b->closures);
    if (!b->model->airbags || !b->closures) return -1;
    for (int i = 0; i < count; i++) {
        FacetList list = {0};
        if (airbag_facets(b, map, &d->airbags.items[i], &list) || close_bag(b, i, &list) ||
            list_bag(b, &b->model->airbags[i], &list))
            status = -1;
        facets_free(&list);
    }
    return status;
}

static int build_facet_map(const Builder *b, FacetMap *map)
{
    return facet_map_build(map, b->records[0].node, (size_t)b->shell_count, sizeof *b->records);
}

int build_surfaces(Builder *b)
{
    FacetMap map = {0};
    int status = build_facet_map(b, &map);
    if (!status) status = find_airbag_surfaces(b, &map);
    facet_map_free(&map);
    return status;
}

int build_pressure_sets(Builder *b)
{
    FacetMap map = {0};
    int status = build_facet_map(b, &map);
    if (!status) status = load_facets(b, &map);
    if (!status) status = assign_pressure_sets(b);
    facet_map_free(&map);
    return status;
}
