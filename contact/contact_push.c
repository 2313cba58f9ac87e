/* Pairs to lanes and back: contact/push_kernels.c has the law. */
#include "contact/contact_push.h"

#include "solver/memory.h"

/* Nodes whose accelerations are formed together. */
enum { PULL_BLOCK = 16 };

int contact_pulls_create(ContactPart *part, int nodes)
{
    part->pull = memory_alloc((size_t)nodes + 1, sizeof *part->pull);
    part->pull_cycle = memory_alloc((size_t)nodes / PULL_BLOCK + 1, sizeof *part->pull_cycle);
    return part->pull && part->pull_cycle ? 0 : -1;
}

int contact_push_begin(ContactPart *part, int count)
{
    size_t blocks = ((size_t)count + PUSH_LANES - 1) / PUSH_LANES;
    part->push_count = 0;
    if (!memory_reserve((void **)&part->push, &part->push_capacity, blocks + 1, sizeof *part->push)) return 0;
    part->failed = true;
    return -1;
}

/* Forms the node's acceleration, once a cycle, and those of the nodes numbered around it: what these are formed from
 * lies together, and their neighbours ask as well. */
static void form_pull(const ContactLoop *loop, ContactPart *part, int32_t node)
{
    int32_t block = node / PULL_BLOCK, end = (block + 1) * PULL_BLOCK, count = loop->model->node_count;
    if (part->pull_cycle[block] == loop->cycle) return;
    part->pull_cycle[block] = loop->cycle;
    for (int32_t n = block * PULL_BLOCK; n < end && n < count; n++) contact_form_pull(loop, n, part->pull[n].a);
}

static void fill_memory(PushPairs *block, int l, const ContactMemory *m)
{
    block->known[l] = m ? 1.0 : 0.0;
    block->last[l] = m ? m->gap : 0.0;
    block->distance[l] = m ? m->distance : 0.0;
    block->k[l] = m ? m->stiffness : 0.0;
    block->limit[l] = m ? m->limit : 0.0;
    for (int k = 0; k < 3; k++) block->friction[k][l] = m ? m->friction[k] : 0.0;
}

void contact_push_add(const ContactLoop *loop, ContactPart *part, const ContactTouch *t, ContactMemory *m, int owner,
                      int32_t other)
{
    PushPairs *block = &part->push[part->push_count / PUSH_LANES];
    const int l = part->push_count++ % PUSH_LANES;
    for (int i = 0; i < 4; i++) {
        block->node[i][l] = t->node[i];
        block->weight[i][l] = t->weight[i];
        form_pull(loop, part, t->node[i]);
        __builtin_prefetch(&loop->node[t->node[i]]);
        __builtin_prefetch(&loop->node[t->node[i]].room[7]);
    }
    block->gap[l] = t->gap;
    block->thickness[l] = t->thickness;
    block->stiffness[l] = t->stiffness;
    for (int k = 0; k < 3; k++) {
        block->direction[k][l] = t->direction[k];
        block->speed[k][l] = t->speed[k];
    }
    fill_memory(block, l, m && m->side ? m : NULL);
    block->memory[l] = m;
    block->owner[l] = owner;
    block->other[l] = other;
    block->side[l] = t->side;
}

/* Lanes that are left over repeat the first pair. */
static void fill_up(PushPairs *block, int from)
{
    for (int l = from; l < PUSH_LANES; l++) {
        for (int i = 0; i < 4; i++) block->node[i][l] = block->node[i][0], block->weight[i][l] = block->weight[i][0];
        for (int k = 0; k < 3; k++) {
            block->direction[k][l] = block->direction[k][0];
            block->speed[k][l] = block->speed[k][0];
        }
        block->gap[l] = block->gap[0];
        block->thickness[l] = block->thickness[0];
        block->stiffness[l] = block->stiffness[0];
        fill_memory(block, l, NULL);
    }
}

void contact_push_all(const ContactLoop *loop, const ContactLaw *law, ContactPart *part)
{
    int blocks = (part->push_count + PUSH_LANES - 1) / PUSH_LANES, over = part->push_count % PUSH_LANES;
    if (over > 0) fill_up(&part->push[blocks - 1], over);
    loop->push_kernels->push(law, part->push, blocks);
}

/* What the pair is to remember. */
static void write_memory(const PushPairs *block, int l, ContactMemory *m)
{
    m->side = block->side[l];
    m->distance = block->distance[l];
    m->stiffness = block->k[l];
    m->gap = (float)block->last[l];
    m->limit = (float)block->limit[l];
    for (int k = 0; k < 3; k++) {
        m->direction[k] = (float)block->direction[k][l];
        m->friction[k] = (float)block->friction[k][l];
    }
}

bool contact_push_take(ContactList *list, const PushPairs *block, int l, ContactSums *sums, ContactForce *out)
{
    const unsigned bit = 1u << l;
    ContactMemory *m = block->memory[l], fresh = {0};
    if (block->lost & bit) sums->lost++, sums->lost_node = block->node[0][l];
    if (block->fast & bit) sums->fast++, sums->fast_node = block->node[0][l];
    if (block->keep & bit) {
        write_memory(block, l, m ? m : &fresh);
        if (!m) contact_keep(list, block->owner[l], block->other[l], &fresh);
    } else if (m) {
        *m = (ContactMemory){0};
    }
    if (!(block->count & bit)) return false;
    for (int i = 0; i < 4; i++) {
        out->node[i] = block->node[i][l];
        out->weight[i] = block->weight[i][l];
    }
    for (int k = 0; k < 3; k++) out->force[k] = block->force[k][l];
    out->load = block->load[l];
    out->firm = block->firm[l];
    out->blocks = true;
    sums->power += block->power[l];
    sums->count++;
    return true;
}
