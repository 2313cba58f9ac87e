/* Definitions made by hand for the tests of sets, constraints and loads: a strip of shells, and cards added one by one.
 */
#ifndef BILLOW_MOTION_DECK_H
#define BILLOW_MOTION_DECK_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "solver/build_motion.h"
#include "solver/memory.h"

/* Appends a record to a LIST of Definitions. */
#define DECK_ADD(LIST, ...)                                                                                            \
    do {                                                                                                               \
        assert_int_equal(                                                                                              \
            memory_reserve((void **)&(LIST).items, &(LIST).capacity, (LIST).count + 1, sizeof *(LIST).items), 0);      \
        (LIST).items[(LIST).count++] = __VA_ARGS__;                                                                    \
    } while (0)

static inline void assert_near(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance)) print_message("%.17g, expected %.17g\n", value, expected);
    assert_true(fabs(value - expected) <= tolerance);
}

/* A deck, its index and what is built from it. */
typedef struct MotionDeck {
    Definitions d;
    DeckIndex index;
    Diagnostics messages;
    Motion motion;
    MotionInput input;
    double x[3 * 64], mass[64], shell_mass[64];
    AirbagNodes bags[2];
} MotionDeck;

/* Curves are given as points; the solver's form is made by deck_curve. */
static inline void deck_add_curve(MotionDeck *deck, int id, int sidr, int count, const double (*points)[2])
{
    CurveDefinition curve = {.id = id, .sidr = sidr, .sfa = 1, .sfo = 1};
    for (int i = 0; i < count; i++) {
        DECK_ADD(curve.x, points[i][0]);
        DECK_ADD(curve.y, points[i][1]);
    }
    DECK_ADD(deck->d.curves, curve);
}

static inline void deck_add_set(MotionDeck *deck, SetKind kind, int id, int count, const int *members)
{
    SetDefinition set = {.kind = kind, .id = id, .source = {0, 100 + id}};
    for (int i = 0; i < count; i++) DECK_ADD(set.members, members[i]);
    DECK_ADD(deck->d.sets, set);
}

/* Nodes 10, 20, .. on two rows (x = 0..n, y = 0 and 1; lower row first) and n quads 1..n: the first half of them part
 * 100, the rest part 200; materials 1 (fabric) and 2 (rigid, free) for cards to choose from. */
static inline void deck_begin_strip(MotionDeck *deck, int n)
{
    memset(deck, 0, sizeof *deck);
    assert_int_equal(diagnostics_add_file(&deck->messages, "deck.k"), 0);
    for (int i = 0; i < 2 * (n + 1); i++) {
        NodeDefinition node = {.id = 10 * (i + 1), .x = {i % (n + 1), i / (n + 1), 0}, .source = {0, i + 1}};
        DECK_ADD(deck->d.nodes, node);
    }
    for (int e = 0; e < n; e++) {
        ShellDefinition shell = {.id = e + 1,
                                 .part = 2 * e < n ? 100 : 200,
                                 .source = {0, 50 + e},
                                 .node = {10 * (e + 1), 10 * (e + 2), 10 * (n + e + 3), 10 * (n + e + 2)}};
        DECK_ADD(deck->d.shells, shell);
        deck->shell_mass[e] = 4;
    }
    DECK_ADD(deck->d.parts, (PartDefinition){.id = 100, .material = 1, .source = {0, 71}});
    DECK_ADD(deck->d.parts, (PartDefinition){.id = 200, .material = 1, .source = {0, 72}});
    DECK_ADD(deck->d.materials, (MaterialDefinition){.id = 1, .kind = MATERIAL_FABRIC});
    DECK_ADD(deck->d.materials, (MaterialDefinition){.id = 2, .kind = MATERIAL_RIGID, .source = {0, 81}});
}

/* Index of the deck; positions and masses as the owner of the build makes them. Returns deck_index_build's status. */
static inline int deck_index(MotionDeck *deck)
{
    int status = deck_index_build(&deck->index, &deck->d, &deck->messages);
    for (size_t i = 0; i < deck->d.nodes.count; i++)
        memcpy(deck->x + 3 * i, deck->d.nodes.items[i].x, 3 * sizeof(double));
    for (size_t e = 0; e < deck->d.shells.count; e++) {
        const ShellDefinition *shell = &deck->d.shells.items[e];
        int corners = shell->node[3] == shell->node[2] ? 3 : 4;
        for (int c = 0; c < corners; c++) {
            int32_t node = id_map_find(&deck->index.nodes, shell->node[c]);
            if (node >= 0) deck->mass[node] += deck->shell_mass[e] / corners;
        }
    }
    deck->input.index = &deck->index;
    deck->input.x = deck->x;
    deck->input.shell_mass = deck->shell_mass;
    deck->input.airbags = deck->bags;
    return status;
}

/* Index and build; returns build_motion's status. */
static inline int deck_build(MotionDeck *deck)
{
    assert_int_equal(deck_index(deck), 0);
    return build_motion(&deck->input, deck->mass, &deck->motion, &deck->messages);
}

static inline void deck_end(MotionDeck *deck)
{
    motion_free(&deck->motion);
    deck_index_free(&deck->index);
    definitions_free(&deck->d);
    diagnostics_free(&deck->messages);
}

/* Number of messages of a severity that contain all three texts (NULL: any), at a line (0: any). */
static inline int deck_messages(const MotionDeck *deck, Severity severity, int line, const char *a, const char *b)
{
    int found = 0;
    for (size_t i = 0; i < deck->messages.count; i++) {
        const Message *m = &deck->messages.messages[i];
        if (m->severity != severity || (line && m->source.line != line)) continue;
        if (a && !strstr(m->text, a) && !strstr(m->keyword, a)) continue;
        if (b && !strstr(m->text, b) && !strstr(m->keyword, b)) continue;
        found++;
    }
    return found;
}

/* Expects exactly one error, at this line and with these words in its keyword or text. */
static inline void deck_expect_error(const MotionDeck *deck, int line, const char *a, const char *b)
{
    if (deck->messages.errors != 1 || deck_messages(deck, SEVERITY_ERROR, line, a, b) != 1) {
        print_message("expected one error in line %d with \"%s\" and \"%s\", got:\n", line, a ? a : "", b ? b : "");
        diagnostics_print(&deck->messages, SEVERITY_NOTE, stdout);
    }
    assert_int_equal(deck->messages.errors, 1);
    assert_int_equal(deck_messages(deck, SEVERITY_ERROR, line, a, b), 1);
}

#endif
