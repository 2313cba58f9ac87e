/* Verification runs: a deck text goes through reader, build and time loop in this process, and what the tests judge is
 * recorded: samples of gas, energies and one node, and the last cycle's nodal fields in deck order. */
#ifndef BILLOW_VERIFY_H
#define BILLOW_VERIFY_H

#include <stddef.h>
#include <stdint.h>

#include "elements/membrane.h"
#include "examples/scene.h"
#include "solver/build.h"
#include "solver/step.h"

/* One recorded cycle, all at the full step t_n. */
typedef struct VerifySample {
    double time, step, element_step;
    double volume, pressure, temperature, mass, area, mass_flow_out; /* of the watched airbag */
    double applied;                                                  /* what its walls feel */
    double x[3], v[3], a[3], f[3];                                   /* of the watched node */
    double kinetic, internal, external;
    double held, given; /* both sides of the energy balance */
} VerifySample;

/* Called on every recorded cycle. */
typedef void VerifyProbe(void *user, const Model *model, const State *state, const StepView *view);

typedef struct VerifyOptions {
    int threads;      /* 0: one */
    int airbag;       /* index of the watched airbag */
    int node;         /* deck index of the watched node */
    int every;        /* record every so many cycles; 0: only the last */
    int64_t stop;     /* > 0: stop after this cycle */
    double stop_time; /* > 0: stop at the first cycle at or after this time */
    bool one_point;   /* one-point quads */
    bool caps_push_rim;
    bool walls_block;    /* nodes on rigid walls count as covered */
    bool all_explicit;   /* no small elements are integrated implicitly */
    double energy_limit; /* > 0: the run stops beyond this share of energy error in place of the default */
    VerifyProbe *probe;
    void *user;
} VerifyOptions;

typedef struct VerifyRun {
    Definitions definitions;
    Diagnostics diagnostics;
    Model model;
    State state;
    Failure failure;
    StageTimes times;
    VerifyOptions options;
    bool ran; /* the loop ended without failure */
    VerifySample *samples;
    size_t count, capacity;
    double *x, *v, *f;  /* last emitted cycle, deck order (model.node_count x 3) */
    double *internal_x; /* its positions in the model's own order */
    int64_t cycles;
    double imbalance; /* largest |held - given| over the recorded cycles */
    double energy;    /* largest energy given in the run */
} VerifyRun;

/* Reads and builds. 0, or -1 with the messages in run->diagnostics. run need not be initialised. */
int verify_build(VerifyRun *run, const char *text, size_t length, const VerifyOptions *options);

/* Runs the built model. 0, or -1 with run->failure. */
int verify_loop(VerifyRun *run);

/* Both for a scene, which is freed; any error of the deck or the loop is printed and fails the cmocka test. */
void verify_scene(VerifyRun *run, Scene *scene, const VerifyOptions *options);

/* Ends a scene and builds its model, which records every cycle; the scene is freed. With errors > 0 it has to be
 * refused with so many. */
void verify_scene_build(VerifyRun *run, Scene *scene, int errors);

void verify_free(VerifyRun *run);

/* A channel at a time between the samples, by cubic interpolation; offset is offsetof(VerifySample, member). */
double verify_at(const VerifyRun *run, double time, size_t offset);

/* Largest and smallest value of a channel from a time on. */
double verify_largest(const VerifyRun *run, double from, size_t offset);
double verify_smallest(const VerifyRun *run, double from, size_t offset);

/* Mean of a channel over time between two times (trapezoidal). */
double verify_mean(const VerifyRun *run, double from, double to, size_t offset);

/* Cauchy stress xx yy zz xy yz zx of the element with the deck's index at the last emitted cycle. */
ElementResult verify_element(const VerifyRun *run, int element);

/* Fails the cmocka test if the energy balance was ever off by more than this share of the largest energy given. */
void verify_balance(const VerifyRun *run, double tolerance);

/* Larger and smaller principal value of a plane stress given in global axes (the third is zero). */
void verify_principal(const double stress[6], double principal[2]);

/* Reference values of geometry, by formulas of the tests' own: enclosed volume (divergence theorem; quads as bilinear
 * patches) about the origin, and area, of shells on positions in deck order. */
double verify_volume(const SceneMesh *mesh, const double *x);
double verify_area(const SceneMesh *mesh, const double *x);

/* Starts the deck of a closed box a x b x c of eight nodes: rigid bottom (part 1, fixed), rigid lid (part 2, of the
 * mass, translation constrained by con1), walls of massless null shells (part 3), all in part set 1; curve 1 is
 * constant 0. The caller adds an airbag and motions and calls scene_end. Deck indices: bottom 0..3, lid 4..7. */
void verify_begin_box(Scene *scene, const double size[3], double lid_mass, int con1, double end_time);

/* Fails the cmocka test unless |value - reference| <= tolerance * |reference|; prints both with the name. */
void verify_close(const char *name, double value, double reference, double tolerance);

/* The same with an absolute tolerance. */
void verify_near(const char *name, double value, double reference, double tolerance);

/* Fails unless low <= value <= high. */
void verify_between(const char *name, double value, double low, double high);

/* True if a message of at least this severity contains the text. */
bool verify_message(const Diagnostics *diagnostics, Severity severity, const char *text);

#endif
