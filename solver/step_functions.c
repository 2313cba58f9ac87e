/* User's functions in the step: evaluated once a bag and cycle, before the bag's gas, which then sees a constant
 * (docs/theory.md, eq. U1). */
#include <math.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/workspace.h"

int step_functions_allocate(Workspace *w)
{
    const Model *m = w->model;
    w->curves = m->curves;
    if (m->function_count == 0) return 0;
    w->live_curves = memory_alloc((size_t)(m->first_function + m->function_count), sizeof *w->live_curves);
    w->function_value = memory_alloc((size_t)m->airbag_count * (size_t)m->function_count + 1, sizeof(double));
    if (!w->live_curves || !w->function_value) return -1;
    memcpy(w->live_curves, m->curves, (size_t)(m->first_function + m->function_count) * sizeof *w->live_curves);
    w->curves = w->live_curves;
    return 0;
}

void step_functions_release(Workspace *w)
{
    memory_free(w->live_curves);
    memory_free(w->function_value);
}

/* A component of the difference of two nodes' vectors, or its length; .. x 3, base may be NULL. */
static double component_of(const double *values, const double *base, const FunctionInput *input)
{
    double difference[3] = {0};
    for (int j = 0; j < 2; j++) {
        if (input->index[j] < 0) continue;
        ptrdiff_t n = 3 * (ptrdiff_t)input->index[j];
        for (int k = 0; k < 3; k++) {
            double value = values[n + k] - (base ? base[n + k] : 0.0);
            difference[k] += j == 0 ? value : -value;
        }
    }
    if (input->component < 3) return difference[input->component];
    return sqrt(difference[0] * difference[0] + difference[1] * difference[1] + difference[2] * difference[2]);
}

static double input_value(const Workspace *w, const GasState *gas, const FunctionInput *input)
{
    const Model *m = w->model;
    /* the value holds over the step, so its time is the middle */
    double time = w->plan.time - 0.5 * w->plan.dt_before;
    switch (input->kind) {
    case INPUT_ARGUMENT:
        return input->component == 0 ? gas->pressure : input->component == 1 ? gas->volume : time;
    case INPUT_TIME:
        return time;
    case INPUT_TIME_STEP:
        return w->plan.dt_before;
    case INPUT_CYCLE:
        return (double)w->state->clock->cycle;
    case INPUT_CURVE:
        return curve_value(&m->curves[input->index[0]], time);
    case INPUT_DISPLACEMENT:
        return component_of(w->state->x, m->initial, input);
    default:
        return component_of(w->state->v, NULL, input);
    }
}

void step_functions_select(Workspace *w, int airbag)
{
    const Model *m = w->model;
    const Airbag *bag = &m->airbags[airbag];
    for (int i = 0; i < bag->function_count; i++)
        w->live_curves[m->first_function + bag->function[i]].y =
            &w->function_value[(ptrdiff_t)airbag * m->function_count + bag->function[i]];
}

int step_functions_evaluate(Workspace *w, int airbag)
{
    const Model *m = w->model;
    const Airbag *bag = &m->airbags[airbag];
    step_functions_select(w, airbag);
    for (int i = 0; i < bag->function_count; i++) {
        const FunctionProgram *program = &m->functions[bag->function[i]];
        double inputs[BILLOW_FUNCTION_INPUTS];
        const char *why = "";
        for (int k = 0; k < program->input_count; k++)
            inputs[k] = input_value(w, &w->state->gas[airbag], &program->input[k]);
        double *value = &w->function_value[(ptrdiff_t)airbag * m->function_count + bag->function[i]];
        if (!function_evaluate(program, inputs, value, &why)) continue;
        step_fail(w, "look at the function's text and at what it divides by", "function %d of airbag %d: %s",
                  m->curves[m->first_function + bag->function[i]].id, bag->id, why);
        return -1;
    }
    return 0;
}
