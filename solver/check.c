/* billow check: reads, validates and reports a deck; no steps, no files. */
#include "solver/check.h"

#include <stdio.h>

#include "io/report.h"
#include "solver/accept.h"
#include "solver/schedule.h"

enum { LISTED_STEPS = 10 };

static void print_report(Accepted *accepted, const char *deck)
{
    const Model *model = &accepted->model;
    OutputPlan plan = model->output;
    schedule_fill_plan(&plan, model->end_time, &accepted->diagnostics);
    printf("%s: %s\n", deck, model->title);
    report_write_keywords(&accepted->definitions, stdout);
    report_write_parts(model, stdout);
    report_write_reference(model, stdout);
    report_write_airbags(model, &accepted->state, stdout);
    report_write_contacts(model, &accepted->diagnostics, stdout);
    report_write_conditions(model, stdout);
    report_write_walls(model, stdout);
    if (report_write_crossings(model, stdout) || report_write_rigid_shapes(model, stdout))
        diagnostics_add(&accepted->diagnostics, SEVERITY_ENVIRONMENT, BILLOW_NO_SOURCE, NULL,
                        "not enough memory to look for intersections of the mesh and shapes of rigid parts");
    report_write_plan(model, &plan, stdout);
    report_write_steps(model, LISTED_STEPS, stdout);
    report_write_messages(&accepted->diagnostics, stdout);
    printf("\n%s: no errors; billow run %s runs it\n", deck, deck);
}

int check_deck(const Options *options)
{
    Accepted accepted = {0};
    if (accept_deck(options, &accepted))
        accept_print_problems(&accepted.diagnostics, options->deck, stderr);
    else
        print_report(&accepted, options->deck);
    const int code = diagnostics_exit_code(&accepted.diagnostics);
    accept_free(&accepted);
    return code;
}
