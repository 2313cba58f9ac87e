/* Which edges stand out of their surface: these meet all others near them (docs/theory.md, Edges). */
#include "contact/contact_loop.h"

/* An edge is sharp where the surface is turned by more than this angle times thickness over longest side: the middle of
 * the edge then stands out by a tenth of the thickness. Never by more than 1.8 degrees. */
#define SHARP_TURN 0.4
#define SHARP_MOST 0.0316

/* Share of that angle from which an edge counts as nearly sharp. */
#define NEARLY 0.7

static ContactSharp find_sharp(const ContactLoop *loop, const ContactRun *run, int group)
{
    const ContactInterface *c = run->contact;
    double turn = c->longest_side > 0.0 ? SHARP_TURN * c->thickest / c->longest_side : SHARP_MOST;
    if (turn > SHARP_MOST) turn = SHARP_MOST;
    const float square[2] = {(float)(turn * turn), (float)(NEARLY * NEARLY * turn * turn)};
    unsigned set[2];
    loop->sharp_kernels->turned(&run->lines.lanes[group], loop->state->x, square, set);
    return (ContactSharp){.now = (uint16_t)set[0], .nearly = (uint16_t)set[1]};
}

/* Two threads may find the same at the same time. */
ContactSharp contact_sharp(const ContactLoop *loop, const ContactRun *run, int group)
{
    uint64_t kept = atomic_load_explicit(&run->sharp[group], memory_order_relaxed), cycle = (uint64_t)loop->cycle << 32;
    if (kept >> 32 << 32 == cycle) return (ContactSharp){.now = (uint16_t)kept, .nearly = (uint16_t)(kept >> 16)};
    ContactSharp sharp = find_sharp(loop, run, group);
    kept = cycle | (uint64_t)sharp.nearly << 16 | sharp.now;
    atomic_store_explicit(&run->sharp[group], kept, memory_order_relaxed);
    return sharp;
}

bool contact_is_sharp(const ContactLoop *loop, const ContactRun *run, int edge)
{
    int place = run->line_place[edge];
    return contact_sharp(loop, run, place / CONTACT_GROUP).now >> place % CONTACT_GROUP & 1;
}
