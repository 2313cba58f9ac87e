/* From the command line's deck to a model and its state at time 0, with the messages users see. */
#include "solver/accept.h"

#include <stdlib.h>

#include "elements/kernels.h"
#include "io/read.h"
#include "solver/build.h"
#include "solver/relax.h"

static void add_memory_error(Diagnostics *diagnostics)
{
    diagnostics_add(diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL, "not enough memory for this deck");
}

/* The state at time 0; the build has refused every impossible start, so that only memory can be missing. */
static int start_state(Accepted *accepted)
{
    if (!kernels_select(NULL)) {
        const char *wish = getenv("BILLOW_KERNELS");
        diagnostics_add(&accepted->diagnostics, SEVERITY_ERROR, BILLOW_NO_SOURCE, NULL,
                        "BILLOW_KERNELS=%s: this processor has no such kernels; use v2, or unset the variable",
                        wish ? wish : "");
        return -1;
    }
    if (state_create(&accepted->model, &accepted->state) == 0) return 0;
    add_memory_error(&accepted->diagnostics);
    return -1;
}

/* The model of the phase before the run, where the deck's curves part the two; its messages are the same again. */
static int build_phase(const Options *options, Accepted *accepted)
{
    Diagnostics *diagnostics = &accepted->diagnostics;
    if (accepted->model.relax.kind == RELAX_NONE) return 0;
    if (accepted->model.relax.phase_curves) {
        Diagnostics again = {0};
        BuildOptions build = options->build;
        build.relaxation_phase = true;
        int status = model_build(&accepted->definitions, &build, &accepted->phase, &again);
        if (status && again.errors > 0)
            for (size_t i = 0; i < again.count; i++)
                if (again.messages[i].severity == SEVERITY_ERROR)
                    diagnostics_add(diagnostics, SEVERITY_ERROR, again.messages[i].source, again.messages[i].keyword,
                                    "%s", again.messages[i].text);
        if (status && again.errors == 0) add_memory_error(diagnostics);
        diagnostics_free(&again);
        if (status) return -1;
    }
    return relax_check(accepted->phase.node_count > 0 ? &accepted->phase : &accepted->model, diagnostics);
}

int accept_deck(const Options *options, Accepted *accepted)
{
    Diagnostics *diagnostics = &accepted->diagnostics;
    const Definitions *definitions = &accepted->definitions;
    for (int i = 0; i < options->note_count; i++)
        diagnostics_add(diagnostics, SEVERITY_NOTE, BILLOW_NO_SOURCE, NULL, "%s", options->notes[i]);
    const int unread = deck_read(options->deck, &accepted->definitions, diagnostics);
    if (unread && diagnostics_exit_code(diagnostics) == BILLOW_EXIT_NORMAL) add_memory_error(diagnostics);
    /* A deck with errors is still built, so that all its errors surface together; unless nothing could be read of it:
     * then every further message would only repeat that. */
    if (unread && (definitions->incomplete || (definitions->nodes.count == 0 && definitions->shells.count == 0)))
        return -1;
    if (diagnostics->environment > 0) return -1;
    const int unbuilt = model_build(definitions, &options->build, &accepted->model, diagnostics);
    if (unbuilt && diagnostics_exit_code(diagnostics) == BILLOW_EXIT_NORMAL) add_memory_error(diagnostics);
    return unread || unbuilt || build_phase(options, accepted) ? -1 : start_state(accepted);
}

void accept_print_problems(const Diagnostics *diagnostics, const char *deck, FILE *stream)
{
    const int errors = diagnostics->errors + diagnostics->environment;
    diagnostics_print(diagnostics, SEVERITY_WARNING, stream);
    if (errors > 0)
        fprintf(stream, "%s: %d error%s, %d warning%s\n", deck, errors, errors == 1 ? "" : "s", diagnostics->warnings,
                diagnostics->warnings == 1 ? "" : "s");
}

void accept_free(Accepted *accepted)
{
    state_free(&accepted->state);
    model_free(&accepted->model);
    model_free(&accepted->phase);
    definitions_free(&accepted->definitions);
    diagnostics_free(&accepted->diagnostics);
}
