/* make_deck: writes the deck of an example or benchmark scene to standard output. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "examples/scene.h"

typedef struct Options {
    const char *name;
    ScenePattern pattern;
    int n, shells, cycles, elform, form;
} Options;

/* The setups of the static references: A1a, A14 (A10 with a stiff fabric) and A11. */
static SceneStatic static_setup(const Options *options, double e, double nu, double thickness, double pressure)
{
    return (SceneStatic){.pattern = options->pattern,
                         .elform = options->elform,
                         .n = options->n > 0 ? options->n : 16,
                         .fabric = scene_isotropic(options->form, true, 800, e, nu),
                         .thickness = thickness,
                         .pressure = pressure,
                         .rise = 0.02,
                         .end = 0.2,
                         .damping = 500,
                         .size = 0.35};
}

static void make_driver_bag(Scene *scene, const Options *options)
{
    scene_driver_bag(scene, options->n);
}

static void make_sewn_bag(Scene *scene, const Options *options)
{
    scene_sewn_bag(scene, options->n);
}

static void make_folding_bag(Scene *scene, const Options *options)
{
    scene_folding_bag(scene, options->n, 0);
}

static void make_wall_bag(Scene *scene, const Options *options)
{
    scene_wall_bag(scene, options->n);
}

static void make_impactor_sphere(Scene *scene, const Options *options)
{
    scene_impactor(scene, options->n, SCENE_SPHERE, 0);
}

static void make_impactor_box(Scene *scene, const Options *options)
{
    scene_impactor(scene, options->n, SCENE_BOX, 0);
}

static void make_impactor_capsule(Scene *scene, const Options *options)
{
    scene_impactor(scene, options->n, SCENE_CAPSULE, 0);
}

static void make_pressed_bag(Scene *scene, const Options *options)
{
    scene_folding_bag(scene, options->n, 20000);
}

static void make_cushion(Scene *scene, const Options *options)
{
    scene_cushion(scene, options->n);
}

static void make_landing_pad(Scene *scene, const Options *options)
{
    scene_landing_pad(scene, options->n);
}

static void make_prestressed_cushion(Scene *scene, const Options *options)
{
    scene_prestressed_cushion(scene, options->n);
}

static void make_folded_bag(Scene *scene, const Options *options)
{
    scene_folded_bag(scene, SCENE_DIAGONAL, options->n, 0);
}

static void make_resting_folded(Scene *scene, const Options *options)
{
    scene_resting_bag(scene, options->n, true);
}

static void make_resting_flat(Scene *scene, const Options *options)
{
    scene_resting_bag(scene, options->n, false);
}

static void make_speed(Scene *scene, const Options *options)
{
    scene_speed(scene, options->pattern, options->shells, options->cycles);
}

static void make_disc(Scene *scene, const Options *options)
{
    SceneStatic setup = static_setup(options, 2e8, 0.3, 3.5e-4, 1000);
    setup.size = 0.3;
    setup.fabric.cse = false;
    scene_static_disc(scene, &setup);
}

static void make_bag(Scene *scene, const Options *options)
{
    SceneStatic setup = static_setup(options, 2e8, 0.3, 3.5e-4, 5000);
    scene_static_bag(scene, &setup);
}

static void make_square(Scene *scene, const Options *options)
{
    SceneStatic setup = static_setup(options, 5.88e8, 0.4, 6e-4, 5000);
    setup.size = 0.424264;
    scene_static_square(scene, &setup);
}

static const struct SceneName {
    const char *name, *text;
    void (*make)(Scene *scene, const Options *options);
} scene_names[] = {
    {"driver-bag", "circular driver bag inflated from flat (-n rings)", make_driver_bag},
    {"cushion", "square cushion inflated from flat (-n cells per side)", make_cushion},
    {"sewn-bag", "disc and ellipse of one perimeter, sewn by their reference geometry (-n rings)", make_sewn_bag},
    {"folding-bag", "driver bag to be folded, blown up by an inflator and damped (-n rings)", make_folding_bag},
    {"wall-bag", "driver bag to be folded, deploys against itself and a wall (-n rings)", make_wall_bag},
    {"impactor-sphere", "a sphere drops on a vented cushion (-n cells per side)", make_impactor_sphere},
    {"impactor-capsule", "a lying capsule drops on a vented cushion (-n cells per side)", make_impactor_capsule},
    {"impactor-box", "a box of a head's size drops on a vented cushion (-n cells per side)", make_impactor_box},
    {"pressed-bag", "the same under a constant pressure of 20 kPa (-n rings)", make_pressed_bag},
    {"landing-pad", "ring-shaped landing pad with a nozzle (-n cells across)", make_landing_pad},
    {"prestressed-cushion", "square cushion, inflated at the start, falls onto the floor (-n cells per side)",
     make_prestressed_cushion},
    {"folded-bag", "square bag folded in eight layers that unfolds against itself (-n cells per side)",
     make_folded_bag},
    {"resting-folded-bag", "the same fabric, folded, blown up and brought to rest (-n cells per side)",
     make_resting_folded},
    {"resting-flat-bag", "the same from flat, without contact (-n cells per side)", make_resting_flat},
    {"disc", "clamped disc under pressure (-n, --pattern, --elform, --form)", make_disc},
    {"bag", "half of a bag of two discs under pressure (-n, --pattern, --elform, --form)", make_bag},
    {"square", "quarter of a square cushion under pressure (-n, --pattern, --elform, --form)", make_square},
    {"speed", "gas-filled pillow for timing (--shells, --cycles, --pattern)", make_speed},
};

enum { SCENE_NAME_COUNT = sizeof scene_names / sizeof scene_names[0] };

static void print_usage(FILE *stream)
{
    fprintf(stream, "usage: make_deck NAME [-n N] [--pattern quads|diagonal|across|cross] [--elform 5|9] [--form 0|2]\n"
                    "                 [--shells N] [--cycles N] > deck.k\n");
    for (int i = 0; i < SCENE_NAME_COUNT; i++)
        fprintf(stream, "  %-20s %s\n", scene_names[i].name, scene_names[i].text);
}

static int parse_pattern(const char *text, ScenePattern *pattern)
{
    static const char *names[] = {"quads", "diagonal", "across", "cross"};
    for (int i = 0; i < 4; i++) {
        if (strcmp(text, names[i]) != 0) continue;
        *pattern = (ScenePattern)i;
        return 0;
    }
    return -1;
}

static int parse_count(const char *text, int *count)
{
    char *end;
    long value = strtol(text, &end, 10);
    if (end == text || *end || value < 0 || value > 100000000) return -1;
    *count = (int)value;
    return 0;
}

/* 0, or -1 with the wrong argument named. */
static int parse_options(int argc, char **argv, Options *options)
{
    for (int i = 1; i < argc; i++) {
        const char *value = i + 1 < argc ? argv[i + 1] : "";
        struct {
            const char *name;
            int *count;
        } counts[] = {{"-n", &options->n},
                      {"--shells", &options->shells},
                      {"--cycles", &options->cycles},
                      {"--elform", &options->elform},
                      {"--form", &options->form}};
        int wrong = 1;
        if (argv[i][0] != '-' && !options->name) {
            options->name = argv[i];
            continue;
        }
        if (strcmp(argv[i], "--pattern") == 0) wrong = parse_pattern(value, &options->pattern);
        for (int k = 0; k < 5; k++)
            if (strcmp(argv[i], counts[k].name) == 0) wrong = parse_count(value, counts[k].count);
        if (wrong) {
            fprintf(stderr, "make_deck: wrong argument: %s %s\n", argv[i], value);
            return -1;
        }
        i++;
    }
    return options->name ? 0 : -1;
}

int main(int argc, char **argv)
{
    Options options = {.pattern = SCENE_DIAGONAL, .shells = 2000, .cycles = 1000, .elform = 9, .form = 2};
    if (argc > 1 && strcmp(argv[1], "--help") == 0) {
        print_usage(stdout);
        return 0;
    }
    if (parse_options(argc, argv, &options)) {
        print_usage(stderr);
        return 2;
    }
    for (int i = 0; i < SCENE_NAME_COUNT; i++) {
        if (strcmp(options.name, scene_names[i].name) != 0) continue;
        Scene scene = {0};
        scene_names[i].make(&scene, &options);
        int status = scene_ok(&scene) ? 0 : 3;
        if (status)
            fprintf(stderr, "make_deck: out of memory\n");
        else if (fwrite(scene.deck.text, 1, scene.deck.length, stdout) != scene.deck.length || fflush(stdout))
            status = 3;
        scene_free(&scene);
        return status;
    }
    fprintf(stderr, "make_deck: no scene named %s\n", options.name);
    print_usage(stderr);
    return 2;
}
