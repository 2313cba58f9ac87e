/* Segments of elements and the rows of corner sums that their nodes have (solver/model.h). */
#include <stdlib.h>

#include "elements/kernels.h"
#include "solver/builder.h"
#include "solver/memory.h"

/* The nodes of the segment at hand. */
typedef struct SegmentNodes {
    int32_t *node; /* ascending (count) */
    int32_t *seen; /* last segment + 1 that a node was seen in (node_count) */
    int32_t *row;  /* its row there (node_count) */
    int count;
} SegmentNodes;

/* Entries [first, end) of the node table that belong to a segment: its blocks with their padding. */
typedef struct TableRange {
    size_t first, end;
} TableRange;

static int cut_segments(Builder *b)
{
    Model *m = b->model;
    int count = 0, least = model_has_contact(m) ? BILLOW_CONTACT_SEGMENTS : BILLOW_LEAST_SEGMENTS;
    int length = m->chunk_count / least;
    length = length < 1 ? 1 : length > BILLOW_SEGMENT_CHUNKS ? BILLOW_SEGMENT_CHUNKS : length;
    for (int g = 0; g < m->group_count; g++) {
        int chunks = (m->groups[g].block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        count += (chunks + length - 1) / length;
    }
    m->segment_chunk = builder_alloc(b, (size_t)count + 1, sizeof *m->segment_chunk);
    m->row_start = builder_alloc(b, (size_t)count + 1, sizeof *m->row_start);
    if (!m->segment_chunk || !m->row_start) return -1;
    for (int g = 0; g < m->group_count; g++) {
        int chunks = (m->groups[g].block_count + BILLOW_CHUNK - 1) / BILLOW_CHUNK;
        for (int c = 0; c < chunks; c += length) m->segment_chunk[m->segment_count++] = m->groups[g].first_chunk + c;
    }
    m->segment_chunk[m->segment_count] = m->chunk_count;
    return 0;
}

static TableRange table_range(const Model *m, const ElementGroup *group, int segment)
{
    size_t first = (size_t)(m->segment_chunk[segment] - group->first_chunk) * BILLOW_CHUNK,
           end = (size_t)(m->segment_chunk[segment + 1] - group->first_chunk) * BILLOW_CHUNK;
    if (end > (size_t)group->block_count) end = (size_t)group->block_count;
    size_t per_block = (size_t)group->corner_count * BILLOW_LANES;
    return (TableRange){first * per_block, end * per_block};
}

static int compare_nodes(const void *left, const void *right)
{
    const int32_t *a = left, *b = right;
    return (*a > *b) - (*a < *b);
}

/* Numbers the rows of one segment by ascending node and fills the group's row table. */
static void number_rows(Model *m, const ElementGroup *group, int32_t *row, int segment, SegmentNodes *nodes)
{
    TableRange range = table_range(m, group, segment);
    nodes->count = 0;
    for (size_t i = range.first; i < range.end; i++) {
        int32_t node = group->node[i];
        if (nodes->seen[node] == segment + 1) continue;
        nodes->seen[node] = segment + 1;
        nodes->node[nodes->count++] = node;
    }
    qsort(nodes->node, (size_t)nodes->count, sizeof *nodes->node, compare_nodes);
    for (int i = 0; i < nodes->count; i++) nodes->row[nodes->node[i]] = m->row_count + i;
    for (size_t i = range.first; i < range.end; i++) row[i] = nodes->row[group->node[i]];
    m->row_count += nodes->count;
    m->row_start[segment + 1] = m->row_count;
}

/* A segment and the mean number of its nodes. */
typedef struct SegmentKey {
    double place;
    int32_t segment;
} SegmentKey;

static int compare_places(const void *left, const void *right)
{
    const SegmentKey *a = left, *b = right;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    return a->segment - b->segment;
}

/* Segments in the order of their nodes, whatever their group: a thread then works on elements and nodes of one region.
 */
static int order_segments(Builder *b)
{
    Model *m = b->model;
    SegmentKey *keys = memory_alloc((size_t)m->segment_count + 1, sizeof *keys);
    m->segment_order = builder_alloc(b, (size_t)m->segment_count + 1, sizeof *m->segment_order);
    int status = keys && m->segment_order ? 0 : -1;
    for (int s = 0; !status && s < m->segment_count; s++) keys[s].segment = s;
    for (int n = 0; !status && n < m->node_count; n++) {
        for (int32_t k = m->node_row_start[n], s = 0;
             k < m->node_row_start[n + 1] && (!model_has_contact(m) || m->node_row[k] < m->contact_row); k++) {
            while (m->row_start[s + 1] <= m->node_row[k]) s++;
            keys[s].place += (double)n / (m->row_start[s + 1] - m->row_start[s]);
        }
    }
    if (!status) qsort(keys, (size_t)m->segment_count, sizeof *keys, compare_places);
    for (int s = 0; !status && s < m->segment_count; s++) m->segment_order[s] = keys[s].segment;
    memory_free(keys);
    return status;
}

static int fill_row_tables(Builder *b, SegmentNodes *nodes)
{
    Model *m = b->model;
    int segment = 0;
    for (int g = 0; g < m->group_count; g++) {
        ElementGroup *group = &m->groups[g];
        size_t entries = (size_t)group->block_count * (size_t)group->corner_count * BILLOW_LANES;
        int32_t *row = builder_alloc(b, entries, sizeof *row);
        int end = g + 1 < m->group_count ? m->groups[g + 1].first_chunk : m->chunk_count;
        if (!row) return -1;
        group->row = row;
        for (; segment < m->segment_count && m->segment_chunk[segment] < end; segment++)
            number_rows(m, group, row, segment, nodes);
    }
    return 0;
}

/* Rows of each node in the order of the segments, and the pressure set of each row. */
static int list_rows(Builder *b, SegmentNodes *nodes)
{
    Model *m = b->model;
    size_t count = (size_t)m->node_count;
    int contact_nodes = model_has_contact(m) ? m->moving_count : 0;
    m->contact_row = m->row_count;
    m->row_count += model_has_contact(m) ? m->node_count : 0;
    m->row_set = builder_alloc(b, (size_t)m->row_count + 1, sizeof *m->row_set);
    m->node_row = builder_alloc(b, (size_t)m->row_count + 1, sizeof *m->node_row);
    m->node_row_start = builder_alloc(b, count + 2, sizeof *m->node_row_start);
    if (!m->row_set || !m->node_row || !m->node_row_start) return -1;
    for (int pass = 0; pass < 2; pass++) {
        for (size_t n = 0; n < count; n++) nodes->seen[n] = 0;
        for (int g = 0, segment = 0; g < m->group_count; g++) {
            const ElementGroup *group = &m->groups[g];
            int end = g + 1 < m->group_count ? m->groups[g + 1].first_chunk : m->chunk_count;
            for (; segment < m->segment_count && m->segment_chunk[segment] < end; segment++) {
                TableRange range = table_range(m, group, segment);
                for (size_t i = range.first; i < range.end; i++) {
                    int32_t node = group->node[i];
                    if (nodes->seen[node] == segment + 1) continue;
                    nodes->seen[node] = segment + 1;
                    m->row_set[group->row[i]] = group->pressure_set;
                    if (pass == 0)
                        m->node_row_start[node + 2]++;
                    else
                        m->node_row[m->node_row_start[node + 1]++] = group->row[i];
                }
            }
        }
        for (int n = 0; n < contact_nodes; n++) { /* the last row of a node has what contact pushes it with */
            m->row_set[m->contact_row + n] = -1;
            if (pass == 0)
                m->node_row_start[n + 2]++;
            else
                m->node_row[m->node_row_start[n + 1]++] = m->contact_row + n;
        }
        for (size_t n = 0; pass == 0 && n < count; n++) m->node_row_start[n + 2] += m->node_row_start[n + 1];
    }
    return 0;
}

int build_rows(Builder *b)
{
    Model *m = b->model;
    size_t count = (size_t)m->node_count + 1;
    SegmentNodes nodes = {.node = memory_alloc(count, sizeof *nodes.node),
                          .seen = memory_alloc(count, sizeof *nodes.seen),
                          .row = memory_alloc(count, sizeof *nodes.row)};
    int status = nodes.node && nodes.seen && nodes.row && !cut_segments(b) && !fill_row_tables(b, &nodes) &&
                         !list_rows(b, &nodes) && !order_segments(b)
                     ? 0
                     : -1;
    m->node_pressure = status ? NULL : builder_alloc(b, count, sizeof *m->node_pressure);
    if (!m->node_pressure) status = -1;
    for (int n = 0; !status && n < m->node_count; n++) {
        int set = m->node_row_start[n + 1] > m->node_row_start[n] ? m->row_set[m->node_row[m->node_row_start[n]]] : -1;
        m->node_pressure[n] = set < 0 ? m->pressure_set_count : set;
    }
    memory_free(nodes.node);
    memory_free(nodes.seen);
    memory_free(nodes.row);
    return status;
}
