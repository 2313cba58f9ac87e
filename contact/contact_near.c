/* Which pairs of a group of owners may touch in this step: groups that have come near enough are looked at closely. */
#include "contact/contact_loop.h"
#include "contact/contact_pairs.h"
#include "solver/memory.h"

/* Steps at the speed at which two groups close now that their candidates shall last, and the most that these go beyond
 * what a step needs, in thicknesses. */
#define CANDIDATE_STEPS 12.0
#define CANDIDATE_THICKNESSES 3.0

/* Lanes of a pair of groups of which nothing was near, sharp or flat. */
enum { ALL_SHARP = 0xffff };

/* Rounding of what is added up in single precision. */
#define ROUND_UP (1.0f + 1e-6f)

/* A group of owners and what it may meet. */
typedef struct NearGroup {
    const ContactRun *run;
    ContactList *list;
    const ContactGroups *own, *all;
    int group, pairs;
    const int32_t *other; /* of its pairs (pairs), and so on */
    float *slack;
    ContactKept *kept;
    const ContactWoken *woken; /* blocks of CONTACT_GROUP pairs */
    float longer, deepest;
    bool edges;
} NearGroup;

/* Of the pairs of edges found those of which one is nearly sharp. If none is found, all are known that are near. */
static void leave_sharp(const ContactLoop *loop, NearGroup *near, int k, ContactLook *look)
{
    ContactKept *kept = &near->kept[k];
    int count = 0;
    kept->own = kept->other = ALL_SHARP;
    if (look->count == 0) return;
    kept->own = contact_sharp(loop, near->run, near->group).nearly;
    kept->other = contact_sharp(loop, near->run, near->other[k]).nearly;
    for (int i = 0; i < look->count; i++) {
        const ContactNearby *found = &look->found[i];
        if (((kept->own >> found->owner) | (kept->other >> found->other)) & 1) look->found[count++] = *found;
    }
    look->count = count;
}

/* Looks closely at pair k, of which two points may come nearer by step: at all that may touch and some more. */
static int look_at(const ContactLoop *loop, NearGroup *near, int k, double step, ContactPart *part)
{
    ContactLook *look = &part->look;
    ContactKept *kept = &near->kept[k];
    double thickness = near->own->radius[near->group] + near->all->radius[near->other[k]];
    double steps = CANDIDATE_STEPS * step, most = CANDIDATE_THICKNESSES * thickness, more = steps < most ? steps : most;
    look->x = loop->state->x;
    look->depth = near->list->depth;
    look->deepest = near->list->deepest[near->group];
    look->owners = &near->own->lanes[near->group];
    look->others = &near->all->lanes[near->other[k]];
    look->reach = thickness + look->deepest + (more > step ? more : step) * (1.0 + 1e-5);
    (near->edges ? loop->kernels->edges : loop->kernels->faces)(look);
    near->slack[k] = contact_slack(look->nearest - thickness);
    kept->slack = near->slack[k];
    if (near->edges) leave_sharp(loop, near, k, look);
    return contact_candidates_find(&part->sorting, kept, k, look, thickness);
}

/* Edges of which one is sharp now and was not nearly so at the last look. -1: all are flat. */
static int sharper(const ContactLoop *loop, const NearGroup *near, int k)
{
    const ContactKept *kept = &near->kept[k];
    if (kept->own == ALL_SHARP && kept->other == ALL_SHARP) return 0;
    unsigned own = contact_sharp(loop, near->run, near->group).now;
    unsigned other = contact_sharp(loop, near->run, near->other[k]).now;
    if (!own && !other) return -1;
    return (own & ~(unsigned)kept->own) || (other & ~(unsigned)kept->other);
}

/* Looks at those of the pairs awake of which not all is known that is near. In part->near are those that have
 * candidates, and the gaps within which these may touch. Returns how many, -1 without memory. */
static int look_around(const ContactLoop *loop, NearGroup *near, ContactPart *part)
{
    int some = 0;
    part->sorting.count = 0;
    for (int first = 0; first < near->pairs; first += CONTACT_GROUP) {
        const ContactWoken *woken = &near->woken[first / CONTACT_GROUP];
        for (unsigned awake = woken->awake; awake; awake &= awake - 1) {
            int k = first + __builtin_ctz(awake);
            ContactKept *kept = &near->kept[k];
            int changed = near->edges ? sharper(loop, near, k) : 0;
            if (changed < 0) continue; /* until an edge is sharp */
            double thickness = near->own->radius[near->group] + near->all->radius[near->other[k]];
            float step = (float)contact_ahead((double)(woken->speed[k - first] * near->longer), thickness) * ROUND_UP;
            float gap = contact_kept_way(kept, near->slack[k]) + step;
            bool known = !changed && gap + near->deepest <= kept->within;
            if (!known && look_at(loop, near, k, (double)step, part)) return -1;
            if (kept->slot != CONTACT_NO_SLOT)
                part->near[some++] = (ContactAwake){.pair = k, .gap = (known ? gap : step) * ROUND_UP};
        }
    }
    return some;
}

/* Brings the group's candidates up to date, and sets the gaps within which those of each slot may touch.
 * Returns whether some may, -1 without memory. */
static int renew_candidates(const ContactLoop *loop, NearGroup *near, ContactPart *part)
{
    ContactCandidates *all = &near->list->candidates[near->group];
    if (memory_reserve((void **)&part->near, &part->near_capacity, (size_t)near->pairs + 1, sizeof *part->near))
        return -1;
    int some = look_around(loop, near, part);
    if (some <= 0) return some;
    if (part->sorting.count > 0 && contact_candidates_merge(all, near->kept, near->pairs, &part->sorting)) return -1;
    if (memory_reserve((void **)&part->limit, &part->limit_capacity, (size_t)all->slots + 1, sizeof *part->limit))
        return -1;
    for (int32_t s = 0; s < all->slots; s++) part->limit[s] = -FLT_MAX;
    for (int k = 0; k < some; k++) part->limit[near->kept[part->near[k].pair].slot] = part->near[k].gap;
    return 1;
}

/* Adds the others that an owner remembers, in their places, and leaves out doubles. Returns how many there are now. */
static int merge_memories(const ContactList *list, int owner, int32_t *other, int count)
{
    const int32_t *partner = list->partner + (ptrdiff_t)owner * CONTACT_SLOTS;
    for (int k = 0; k < list->held[owner]; k++) {
        int place = count;
        while (place > 0 && other[place - 1] > partner[k]) place--;
        if (place > 0 && other[place - 1] == partner[k]) continue;
        for (int i = count; i > place; i--) other[i] = other[i - 1];
        other[place] = partner[k];
        count++;
    }
    return count;
}

/* Of the others of a flat edge those that are sharp. Returns how many. */
static int keep_sharp(const ContactLoop *loop, const ContactRun *run, int32_t *other, int count)
{
    int kept = 0;
    for (int i = 0; i < count; i++)
        if (contact_is_sharp(loop, run, other[i])) other[kept++] = other[i];
    return kept;
}

static bool remembers(const ContactList *list, const ContactLanes *lanes)
{
    for (int i = 0; i < CONTACT_GROUP && lanes->item[i] >= 0; i++)
        if (list->held[lanes->item[i]]) return true;
    return false;
}

/* The candidates of each owner that may touch, if there are some, and what it remembers. */
static int list_others(const ContactLoop *loop, const NearGroup *near, bool some, ContactPart *part,
                       int start[CONTACT_GROUP + 1])
{
    const ContactCandidates *all = &near->list->candidates[near->group];
    const ContactLanes *lanes = &near->own->lanes[near->group];
    unsigned sharp = near->edges && some ? contact_sharp(loop, near->run, near->group).now : ~0u;
    int count = 0;
    if (memory_reserve((void **)&part->other, &part->other_capacity,
                       (size_t)(all->first[CONTACT_GROUP] + CONTACT_GROUP * CONTACT_SLOTS) + CONTACT_GROUP,
                       sizeof *part->other))
        return -1;
    for (int l = 0; l < CONTACT_GROUP; l++) {
        int32_t item = lanes->item[l], first = all->first[l], *other = part->other + count;
        int found = 0;
        start[l] = count;
        if (item < 0) continue;
        if (some && all->first[l + 1] > first) {
            float deep = near->deepest > 0.0f ? (float)near->list->depth[item] * ROUND_UP : 0.0f;
            found = loop->kernels->pick(all->gap + first, all->slot + first, all->item + first,
                                        all->first[l + 1] - first, part->limit, deep, other);
        }
        if (!(sharp >> l & 1)) found = keep_sharp(loop, near->run, other, found);
        if (near->list->held[item]) found = merge_memories(near->list, item, other, found);
        count += found;
    }
    start[CONTACT_GROUP] = count;
    return 0;
}

/* What is known of a pair, and the nodes of its second group; dissolved as contact_fetch must be. */
__attribute__((always_inline)) static inline void ask_for(const ContactList *list, const ContactGroups *others,
                                                          int32_t pair)
{
    const ContactLanes *lanes = &others->lanes[list->pairs.other[pair]];
    __builtin_prefetch(list->pairs.kept + pair);
    for (int n = 0; n < 3; n++) __builtin_prefetch(lanes->node[n]);
}

void contact_wake(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread, int turn)
{
    ContactList *list = edges ? &run->edges : &run->faces;
    ContactPart *part = &loop->parts[thread];
    const ContactGroups *own = edges ? &run->lines : &run->nodes;
    int32_t first = list->start[group], pairs = list->start[group + 1] - first;
    size_t blocks = ((size_t)pairs + CONTACT_GROUP - 1) / CONTACT_GROUP;
    ContactWatch watch = {.own = own,
                          .others = edges ? &run->lines : &run->triangles,
                          .group = group,
                          .before = (float)loop->step.before,
                          .longer = (float)loop->step.longer,
                          .least = (float)own->radius[group],
                          .deepest = (float)list->deepest[group] * ROUND_UP};
    if (memory_reserve((void **)&part->woken[turn], &part->woken_capacity[turn], blocks + 1, sizeof **part->woken)) {
        part->failed = true;
        return;
    }
    if (list->holds[group]) contact_fetch(list, &own->lanes[group]);
    for (size_t b = 0; b < blocks; b++) {
        ContactWoken *woken = &part->woken[turn][b];
        int32_t k = first + (int32_t)b * CONTACT_GROUP, left = list->start[group + 1] - k;
        woken->awake = loop->motion_kernels->wake(&watch, list->pairs.other + k, list->pairs.slack + k,
                                                  left < CONTACT_GROUP ? left : CONTACT_GROUP, woken->speed);
        for (unsigned awake = woken->awake; awake; awake &= awake - 1)
            ask_for(list, watch.others, k + __builtin_ctz(awake));
    }
}

void contact_find_near(ContactLoop *loop, ContactRun *run, bool edges, int group, int thread, int turn,
                       int start[CONTACT_GROUP + 1])
{
    ContactList *list = edges ? &run->edges : &run->faces;
    ContactPart *part = &loop->parts[thread];
    int32_t first = list->start[group];
    NearGroup near = {.run = run,
                      .list = list,
                      .own = edges ? &run->lines : &run->nodes,
                      .all = edges ? &run->lines : &run->triangles,
                      .group = group,
                      .pairs = list->start[group + 1] - first,
                      .other = list->pairs.other + first,
                      .slack = list->pairs.slack + first,
                      .kept = list->pairs.kept + first,
                      .woken = part->woken[turn],
                      .longer = (float)loop->step.longer,
                      .deepest = (float)list->deepest[group] * ROUND_UP,
                      .edges = edges};
    start[CONTACT_GROUP] = 0;
    int some = renew_candidates(loop, &near, part);
    if (list->holds[group]) list->holds[group] = remembers(list, &near.own->lanes[group]);
    if (some == 0 && !list->holds[group]) return;
    list->holds[group] = 1; /* what is near may come to be held */
    if (some < 0 || list_others(loop, &near, some > 0, part, start)) part->failed = true;
}

ContactForce *contact_force_room(ContactPart *part, size_t more)
{
    if (memory_reserve((void **)&part->force, &part->force_capacity, part->force_count + more, sizeof *part->force)) {
        part->failed = true;
        return NULL;
    }
    return part->force + part->force_count;
}
