/* User's functions -> programs of the model with their nodes and curves found, and a curve of one point for each, which
 * the step sets to the function's value. */
#include <string.h>

#include "solver/builder.h"

static int find_nodes(Builder *b, const FunctionDefinition *definition, FunctionInput *input)
{
    for (int i = 0; i < 2; i++) {
        if (input->id[i] == 0) continue;
        input->index[i] = id_map_find(&b->index.nodes, input->id[i]);
        if (input->index[i] >= 0) continue;
        diagnostics_add(b->diagnostics, SEVERITY_ERROR, definition->source, "*DEFINE_CURVE_FUNCTION",
                        "function %d names node %d, which is not defined", definition->id, input->id[i]);
        return -1;
    }
    return 0;
}

static int find_inputs(Builder *b, const FunctionDefinition *definition, FunctionProgram *program)
{
    int status = 0;
    for (int i = 0; i < program->input_count; i++) {
        FunctionInput *input = &program->input[i];
        if (input->kind == INPUT_DISPLACEMENT || input->kind == INPUT_VELOCITY) {
            if (find_nodes(b, definition, input)) status = -1;
        } else if (input->kind == INPUT_CURVE) {
            input->index[0] = deck_index_curve(&b->index, input->id[0], "LC", definition->source,
                                               "*DEFINE_CURVE_FUNCTION", b->diagnostics);
            if (input->index[0] < 0) status = -1;
        }
    }
    return status;
}

int build_functions(Builder *b)
{
    const Definitions *d = b->definitions;
    Model *m = b->model;
    int status = 0;
    m->function_count = (int)d->functions.count;
    m->functions = builder_alloc(b, d->functions.count + 1, sizeof *m->functions);
    if (!m->functions) return -1;
    for (int i = 0; i < m->function_count; i++) {
        const FunctionDefinition *definition = &d->functions.items[i];
        FunctionProgram *program = &m->functions[i];
        Curve *curve = &m->curves[m->first_function + i];
        *program = definition->program;
        program->code = builder_alloc(b, (size_t)program->code_count, sizeof *program->code);
        double *point = builder_alloc(b, 3, sizeof *point);
        if (!program->code || !point) return -1;
        memcpy(program->code, definition->program.code, (size_t)program->code_count * sizeof *program->code);
        *curve = (Curve){.id = definition->id, .count = 1, .x = point, .y = point + 1, .area = point + 2};
        if (find_inputs(b, definition, program)) status = -1;
    }
    return status;
}

void renumber_functions(Builder *b, const int32_t *new_index)
{
    for (int i = 0; i < b->model->function_count; i++) {
        FunctionProgram *program = &b->model->functions[i];
        for (int k = 0; k < program->input_count; k++) {
            FunctionInput *input = &program->input[k];
            if (input->kind != INPUT_DISPLACEMENT && input->kind != INPUT_VELOCITY) continue;
            for (int j = 0; j < 2; j++)
                if (input->index[j] >= 0) input->index[j] = new_index[input->index[j]];
        }
    }
}
