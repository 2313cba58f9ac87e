/* The command line: billow's own spelling and LS-DYNA's. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* sched_getaffinity */
#endif
#include "solver/options.h"

#include <errno.h>
#include <math.h>
#include <sched.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define HINT "; billow --help shows the usage"

/* An option that takes no value or one: its names and what reads it. */
typedef struct OptionName {
    const char *shorter, *longer;
    bool takes_value;
    bool for_check; /* also an option of billow check */
    int (*read)(Options *options, const char *value);
} OptionName;

static int refuse(Options *options, const char *format, ...) __attribute__((format(printf, 2, 3)));

static int refuse(Options *options, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    vsnprintf(options->error, sizeof options->error, format, values);
    va_end(values);
    return -1;
}

/* A whole positive integer of at most limit, or -1. */
static int parse_count(const char *text, int limit)
{
    char *end;
    errno = 0;
    const long value = strtol(text, &end, 10);
    if (end == text || *end || errno || value < 1 || value > limit) return -1;
    return (int)value;
}

/* A finite positive number, or -1. */
static double parse_positive(const char *text)
{
    char *end;
    const double value = strtod(text, &end);
    return end == text || *end || !isfinite(value) || value <= 0.0 ? -1.0 : value;
}

static int read_threads(Options *options, const char *value)
{
    options->threads = parse_count(value, BILLOW_MAX_THREADS);
    if (options->threads > 0) return 0;
    return refuse(options, "'%s' is not a number of threads; give 1 to %d", value, BILLOW_MAX_THREADS);
}

static int read_ncpu(Options *options, const char *value)
{
    /* LS-DYNA writes a negative number for "consistent" sums; billow's always are. */
    return read_threads(options, *value == '-' ? value + 1 : value);
}

static int read_end_time(Options *options, const char *value)
{
    options->build.end_time = parse_positive(value);
    if (options->build.end_time > 0.0) return 0;
    return refuse(options, "'%s' is not an end time; give a positive number in the deck's unit of time", value);
}

static int read_energy_limit(Options *options, const char *value)
{
    options->build.energy_error_limit = parse_positive(value);
    if (options->build.energy_error_limit > 0.0) return 0;
    return refuse(options, "'%s' is not an energy error limit; give a positive share, for example 0.2", value);
}

static int read_directory(Options *options, const char *value)
{
    options->directory = value;
    return 0;
}

static int read_restart(Options *options, const char *value)
{
    options->restart = value;
    return 0;
}

static int read_deck(Options *options, const char *value)
{
    if (options->deck) return refuse(options, "two decks are given, '%s' and '%s'" HINT, options->deck, value);
    options->deck = value;
    return 0;
}

static int read_job(Options *options, const char *value)
{
    options->job = value;
    return 0;
}

static int read_ignored(Options *options, const char *word)
{
    if (options->note_count >= BILLOW_OPTION_NOTES) return 0;
    snprintf(options->notes[options->note_count++], BILLOW_OPTION_TEXT,
             "%s on the command line has no effect: billow takes the memory it needs", word);
    return 0;
}

static int read_sensor_library(Options *options, const char *value)
{
    options->build.sensor_library = value;
    return 0;
}

static int set_quiet(Options *options, const char *value)
{
    (void)value;
    options->quiet = true;
    return 0;
}

static int set_one_point(Options *options, const char *value)
{
    (void)value;
    options->build.one_point_quads = true;
    return 0;
}

static int set_relax(Options *options, const char *value)
{
    (void)value;
    options->build.relax = true;
    return 0;
}

static int set_all_explicit(Options *options, const char *value)
{
    (void)value;
    options->build.all_explicit = true;
    return 0;
}

static int set_caps_push(Options *options, const char *value)
{
    (void)value;
    options->build.caps_push_rim = true;
    return 0;
}

static int set_walls_block(Options *options, const char *value)
{
    (void)value;
    options->build.walls_block = true;
    return 0;
}

static const OptionName option_names[] = {
    {"-o", "--output", true, false, read_directory},
    {"-j", "--threads", true, true, read_threads},
    {NULL, "--end-time", true, true, read_end_time},
    {NULL, "--restart", true, false, read_restart},
    {"-q", "--quiet", false, false, set_quiet},
    {NULL, "--one-point-quads", false, true, set_one_point},
    {NULL, "--caps-push-rim", false, true, set_caps_push},
    {NULL, "--walls-block", false, true, set_walls_block},
    {NULL, "--all-explicit", false, true, set_all_explicit},
    {NULL, "--relax", false, true, set_relax},
    {NULL, "--energy-error-limit", true, true, read_energy_limit},
    {NULL, "--sensor-library", true, true, read_sensor_library},
};
enum { OPTION_NAMES = sizeof option_names / sizeof *option_names };

/* The option that word names, and in *value what follows it within the word (-j4, --end-time=2), NULL if nothing. */
static const OptionName *find_option(const char *word, const char **value)
{
    *value = NULL;
    for (int i = 0; i < OPTION_NAMES; i++) {
        const OptionName *name = &option_names[i];
        const size_t length = strlen(name->longer);
        if (strcmp(word, name->longer) == 0) return name;
        if (strncmp(word, name->longer, length) == 0 && word[length] == '=') {
            *value = word + length + 1;
            return name;
        }
        if (!name->shorter || strncmp(word, name->shorter, 2) != 0) continue;
        if (word[2] && !name->takes_value) continue;
        if (word[2]) *value = word + 2;
        return name;
    }
    return NULL;
}

/* One word that starts with '-' and possibly the next; returns the words used or -1. */
static int parse_option(Options *options, const char *word, const char *next, bool check)
{
    const char *value;
    const OptionName *name = find_option(word, &value);
    if (!name) return refuse(options, "unknown option '%s'" HINT, word);
    if (check && !name->for_check) return refuse(options, "option '%s' has no meaning for billow check" HINT, word);
    if (!name->takes_value && value) return refuse(options, "option '%s' takes no value" HINT, word);
    if (!name->takes_value) return name->read(options, NULL) ? -1 : 1;
    const bool inside = value != NULL;
    if (!inside) value = next;
    if (!value || !*value) return refuse(options, "option '%s' needs a value" HINT, word);
    if (name->read(options, value)) return -1;
    return inside ? 1 : 2;
}

/* billow run ... and billow check ... */
static int parse_words(int argc, char *const *argv, Options *options)
{
    const bool check = options->command == COMMAND_CHECK;
    bool only_decks = false;
    for (int i = 2; i < argc;) {
        const char *word = argv[i];
        if (!only_decks && strcmp(word, "--") == 0) {
            only_decks = true;
            i++;
            continue;
        }
        if (!only_decks && (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0)) {
            options->command = check ? COMMAND_CHECK_HELP : COMMAND_RUN_HELP;
            return 0;
        }
        if (only_decks || *word != '-') {
            if (read_deck(options, word)) return -1;
            i++;
            continue;
        }
        const int used = parse_option(options, word, i + 1 < argc ? argv[i + 1] : NULL, check);
        if (used < 0) return -1;
        i += used;
    }
    if (!options->deck || !*options->deck)
        return refuse(options, "no deck is given; write: billow %s DECK", check ? "check" : "run");
    return 0;
}

/* billow fold DECK FOLDS [-o FILE] */
static int parse_fold(int argc, char *const *argv, Options *options)
{
    options->command = COMMAND_FOLD;
    for (int i = 2; i < argc; i++) {
        const char *word = argv[i];
        if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0) {
            options->command = COMMAND_FOLD_HELP;
            return 0;
        }
        if (strcmp(word, "-o") == 0 || strcmp(word, "--output") == 0) {
            if (i + 1 == argc || !*argv[i + 1]) return refuse(options, "option '%s' needs a value" HINT, word);
            options->directory = argv[++i];
        } else if (*word == '-') {
            return refuse(options, "option '%s' has no meaning for billow fold" HINT, word);
        } else if (!options->deck) {
            options->deck = word;
        } else if (!options->folds) {
            options->folds = word;
        } else {
            return refuse(options, "'%s' is one word too many; write: billow fold DECK FOLDS [-o FILE]", word);
        }
    }
    if (options->folds && *options->deck && *options->folds) return 0;
    return refuse(options, "a flat deck and a file of folds are needed; write: billow fold DECK FOLDS [-o FILE]");
}

static bool is_assignment(const char *word)
{
    const char *equal = strchr(word, '=');
    return equal && equal > word && *word != '-';
}

/* billow i=DECK ncpu=2 endtime=T jobid=NAME r=FILE */
static int parse_assignments(int argc, char *const *argv, Options *options)
{
    static const struct {
        const char *name;
        int (*read)(Options *options, const char *value);
    } names[] = {{"i", read_deck},    {"ncpu", read_ncpu}, {"endtime", read_end_time}, {"jobid", read_job},
                 {"r", read_restart}, {"memory", NULL},    {"memory2", NULL}};
    options->command = COMMAND_RUN;
    for (int i = 1; i < argc; i++) {
        const char *word = argv[i];
        const char *equal = strchr(word, '=');
        if (!is_assignment(word)) return refuse(options, "'%s' does not go with NAME=VALUE words" HINT, word);
        size_t k = 0;
        while (k < sizeof names / sizeof *names && (strlen(names[k].name) != (size_t)(equal - word) ||
                                                    strncasecmp(names[k].name, word, (size_t)(equal - word)) != 0))
            k++;
        if (k == sizeof names / sizeof *names)
            return refuse(options, "unknown word '%s'; known are i= ncpu= endtime= jobid= r= memory=" HINT, word);
        if (!equal[1]) return refuse(options, "'%s' needs a value" HINT, word);
        if (names[k].read ? names[k].read(options, equal + 1) : read_ignored(options, word)) return -1;
    }
    if (!options->deck) return refuse(options, "no deck is given; write: billow i=DECK" HINT);
    return 0;
}

int options_parse(int argc, char *const *argv, Options *options)
{
    *options = (Options){.command = COMMAND_HELP};
    if (argc < 2) return refuse(options, "nothing to do; write: billow run DECK" HINT);
    const char *word = argv[1];
    if (strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0) return 0;
    if (strcmp(word, "--version") == 0 || strcmp(word, "-V") == 0) {
        options->command = COMMAND_VERSION;
        return 0;
    }
    if (strcmp(word, "run") == 0 || strcmp(word, "check") == 0) {
        options->command = *word == 'r' ? COMMAND_RUN : COMMAND_CHECK;
        return parse_words(argc, argv, options);
    }
    if (strcmp(word, "fold") == 0) return parse_fold(argc, argv, options);
    if (is_assignment(word)) return parse_assignments(argc, argv, options);
    return refuse(options, "unknown command '%s'; to run a deck write: billow run DECK" HINT, word);
}

int options_directory(const Options *options, char *directory, size_t length)
{
    if (options->directory) return snprintf(directory, length, "%s", options->directory) < (int)length ? 0 : -1;
    if (options->job) return snprintf(directory, length, "%s.results", options->job) < (int)length ? 0 : -1;
    const char *slash = strrchr(options->deck, '/');
    const char *name = slash ? slash + 1 : options->deck;
    const char *dot = strrchr(name, '.');
    const int stem = (int)(dot && dot > name ? (size_t)(dot - name) : strlen(name));
    return snprintf(directory, length, "%.*s.results", stem, name) < (int)length ? 0 : -1;
}

int options_processors(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set)) return 1;
    const int count = CPU_COUNT(&set);
    return count > 0 ? count : 1;
}

int options_threads(const Options *options, const char *environment, int processors)
{
    int threads = options->threads;
    if (threads < 1 && environment) threads = (int)strtol(environment, NULL, 10);
    if (threads < 1) threads = processors;
    if (threads < 1) threads = 1;
    return threads < BILLOW_MAX_THREADS ? threads : BILLOW_MAX_THREADS;
}
