/* Newton's method with an adaptive shift and a line search on the total potential. */
#include "solver/relax_newton.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solver/memory.h"
#include "solver/relax_exact.h"
#include "solver/signals.h"

enum { HALVINGS = 3, SYMMETRIC = 15 }; /* SYMMETRIC: factorisations before the exact tangent takes over, if need be */
#define LEAST_SHIFT 1e-14
#define LARGEST_SHIFT 1e3

typedef struct Newton {
    RelaxSystem *system;
    const NewtonOptions *options;
    double *x, *trial;                        /* positions (node_count x 3) */
    double *residual, *middle, *after, *step; /* (unknown_count) */
    double shift;
    bool exact;   /* some tangent is not symmetric */
    double size;  /* of the model [L] */
    double reach; /* largest step of an unknown [L] */
    NewtonResult *result;
} Newton;

static double product(int n, const double *a, const double *b)
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

static double model_size(const Model *m, const double *x)
{
    double size = 0.0;
    for (int k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int n = 0; n < m->node_count; n++) {
            low = fmin(low, x[3 * n + k]);
            high = fmax(high, x[3 * n + k]);
        }
        size = fmax(size, high - low);
    }
    return size;
}

/* Change of the potential over the step times factor: minus the work of the residual along it, by Simpson's rule,
 * exact for forces that are cubic in the positions (eq. Q14). residual at the end stays in after. */
static double potential_change(Newton *n, double factor, double *load)
{
    RelaxSystem *s = n->system;
    int count = s->unknown_count;
    relax_system_move(s, n->x, 0.5 * factor, n->step, n->trial);
    relax_system_assemble(s, n->trial, false, n->middle, load);
    relax_system_move(s, n->x, factor, n->step, n->trial);
    relax_system_assemble(s, n->trial, false, n->after, load);
    return -factor / 6.0 *
           (product(count, n->residual, n->step) + 4.0 * product(count, n->middle, n->step) +
            product(count, n->after, n->step));
}

/* Factorises with a shift at which the matrix is positive definite, and solves. */
static int find_step(Newton *n)
{
    for (;;) {
        n->result->factorisations++;
        int status = relax_system_solve(n->system, n->shift, n->residual, n->step);
        if (status <= 0) return status;
        if (n->result->factorisations >= n->options->iterations) return 1;
        n->shift = fmax(4.0 * n->shift, 1e-8);
        if (n->shift > LARGEST_SHIFT) return 1;
    }
}

/* Shortens a step that is out of all proportion; the factor it was shortened by. */
static double limit_step(Newton *n)
{
    double largest = 0.0;
    int count = n->system->unknown_count;
    for (int i = 0; i < count; i++) largest = fmax(largest, fabs(n->step[i]));
    double factor = largest > n->reach ? n->reach / largest : 1.0;
    return factor;
}

/* Tries the step and its halves; the factor accepted, 0 if none was. */
static double search(Newton *n, double *load)
{
    int count = n->system->unknown_count;
    double most = limit_step(n), slope = product(count, n->residual, n->step), bend = 0.0;
    for (int i = 0; i < count; i++) bend += n->system->scale[i] * n->step[i] * n->step[i];
    bend = slope - n->shift * bend; /* d.K.d, since (K + shift D) d = r */
    double factor = most;
    for (int i = 0; i <= HALVINGS; i++, factor *= 0.5) {
        double change = potential_change(n, factor, load), model = -factor * slope + 0.5 * factor * factor * bend;
        if (!(change < 0.1 * model)) continue;
        double gain = change / model; /* 1: the quadratic model was right */
        if (factor < most)
            n->shift *= 4.0;
        else if (gain > 0.7 && most == 1.0)
            n->shift *= gain > 0.95 && gain < 1.05 ? 0.1 : 0.3;
        else if (gain < 0.3)
            n->shift *= 3.0;
        n->shift = fmin(fmax(n->shift, LEAST_SHIFT), LARGEST_SHIFT);
        return factor;
    }
    n->shift = fmax(8.0 * n->shift, 1e-10);
    return 0.0;
}

static void find_worst(Newton *n)
{
    double largest = -1.0;
    for (int i = 0; i < n->system->unknown_count; i++)
        if (fabs(n->residual[i]) > largest) {
            largest = fabs(n->residual[i]);
            n->result->worst = n->system->unknown_node[i];
        }
}

static bool went_far(const Newton *n)
{
    const Model *m = n->system->model;
    for (int i = 0; i < 3 * m->node_count; i++)
        if (!(fabs(n->x[i] - m->initial[i]) < 20.0 * n->size)) return true;
    return false;
}

static int iterate(Newton *n)
{
    RelaxSystem *s = n->system;
    NewtonResult *result = n->result;
    double load;
    const int most = n->exact && n->options->iterations > SYMMETRIC ? SYMMETRIC : n->options->iterations;
    relax_system_assemble(s, n->x, true, n->residual, &load);
    for (;;) {
        double size = sqrt(product(s->unknown_count, n->residual, n->residual));
        if (result->steps == 0 && result->factorisations == 0 && !(load > 0.0))
            result->load = size; /* prestrain alone */
        result->load = fmax(load, result->load);
        result->residual = result->load > 0.0 ? size / result->load : size;
        result->shift = n->shift;
        if (n->options->progress)
            fprintf(n->options->progress, "%4d %4d  residual %.3e  shift %.1e\n", result->steps, result->factorisations,
                    result->residual, n->shift);
        if (result->residual <= n->options->tolerance) return 0;
        result->stopped = signals_stop_requested();
        if (result->stopped || result->factorisations >= most || n->shift >= LARGEST_SHIFT) return 1;
        int status = find_step(n);
        if (status) return status;
        if (search(n, &load) == 0.0) continue;
        memcpy(n->x, n->trial, 3 * (size_t)s->model->node_count * sizeof *n->x);
        result->steps++;
        relax_system_assemble(s, n->x, true, n->residual, &load);
        if (went_far(n)) {
            result->far = true;
            return 1;
        }
    }
}

int relax_newton(RelaxSystem *system, const NewtonOptions *options, double *x, NewtonResult *result)
{
    *result = (NewtonResult){.worst = -1};
    size_t count = (size_t)system->unknown_count + 1;
    double size = model_size(system->model, x);
    Newton n = {.system = system,
                .options = options,
                .x = x,
                .trial = memory_alloc(3 * (size_t)system->model->node_count + 1, sizeof(double)),
                .residual = memory_alloc(count, sizeof(double)),
                .middle = memory_alloc(count, sizeof(double)),
                .after = memory_alloc(count, sizeof(double)),
                .step = memory_alloc(count, sizeof(double)),
                .shift = 1e-2,
                .exact = relax_needs_exact(system),
                .size = size,
                .reach = 0.2 * size,
                .result = result};
    int status = n.trial && n.residual && n.middle && n.after && n.step ? 0 : -1;
    if (!status && system->unknown_count > 0) status = iterate(&n);
    if (status == 1 && n.exact && !result->stopped && !result->far) {
        result->shift = 1e-2;
        status = relax_exact(system, options, size, x, result);
        if (status == 1) relax_system_assemble(system, x, false, n.residual, &(double){0});
    }
    if (status == 1) find_worst(&n);
    void *blocks[] = {n.trial, n.residual, n.middle, n.after, n.step};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) memory_free(blocks[i]);
    return status;
}
