/* *INCLUDE, *INCLUDE_PATH(_RELATIVE) and *INCLUDE_TRANSFORM: finding the files and reading their transforms. */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "io/deck_file.h"
#include "io/deck_loader.h"
#include "io/include_transform.h"
#include "solver/memory.h"

/* Length of the folder's part of a path, its slash included; 0 for a bare name. */
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* The name on this and its continuation lines (each but the last ends in " +"), trimmed. False if there is none. */
static bool read_file_name(CardReader *cards, char name[BILLOW_LONGEST_PATH], Source *source)
{
    size_t length = 0;
    const DeckLine *line = card_peek(cards);
    if (!line) return false;
    *source = line->source;
    bool more = true;
    for (; more && (line = card_peek(cards)) != NULL; card_skip(cards)) {
        const char *text = line->text;
        while (*text == ' ') text++;
        size_t part = strlen(text);
        while (part > 0 && text[part - 1] == ' ') part--;
        more = part > 1 && text[part - 1] == '+' && text[part - 2] == ' ';
        if (more) part--;
        while (part > 0 && text[part - 1] == ' ') part--;
        if (length + part >= BILLOW_LONGEST_PATH) part = BILLOW_LONGEST_PATH - 1 - length;
        memcpy(name + length, text, part);
        length += part;
    }
    name[length] = '\0';
    return true;
}

/* A name that is a text parameter stands for its text. */
static void replace_parameter(DeckLoader *loader, const DeckBlock *block, char name[BILLOW_LONGEST_PATH])
{
    if (name[0] != '&') return;
    const Parameter *parameter =
        parameters_find(loader->deck->parameters, name + 1, strlen(name + 1), block->order, block->scope);
    if (parameter && parameter->type == 'C') snprintf(name, BILLOW_LONGEST_PATH, "%s", parameter->text);
}

/* folder + name into path if such a file exists. */
static bool try_path(const char *folder, size_t length, const char *name, char path[BILLOW_LONGEST_PATH])
{
    int written = snprintf(path, BILLOW_LONGEST_PATH, "%.*s%s", (int)length, folder, name);
    return written > 0 && written < BILLOW_LONGEST_PATH && deck_file_exists(path);
}

/* Searches the main deck's folder, the including file's, those of *INCLUDE_PATH and the working directory. */
static bool search_file(const DeckLoader *loader, const char *name, char path[BILLOW_LONGEST_PATH])
{
    if (name[0] == '/') return try_path("", 0, name, path);
    const char *main_deck = loader->open[0].name;
    const char *present = loader->open[loader->depth - 1].name;
    const TextStore *store = loader->deck->store;
    if (try_path(main_deck, folder_length(main_deck), name, path)) return true;
    if (try_path(present, folder_length(present), name, path)) return true;
    for (size_t i = 0; i < store->folders.count; i++) {
        const char *folder = store->folders.items[i];
        if (try_path(folder, strlen(folder), name, path)) return true;
    }
    return try_path("", 0, name, path);
}

/* Finds the file of that name, written with \ for / perhaps; reports if there is none. */
static bool find_file(DeckLoader *loader, const DeckBlock *block, char name[BILLOW_LONGEST_PATH], Source source,
                      char path[BILLOW_LONGEST_PATH])
{
    if (search_file(loader, name, path)) return true;
    for (char *c = name; *c; c++) {
        if (*c == '\\') *c = '/';
    }
    if (search_file(loader, name, path)) return true;
    const char *main_deck = loader->open[0].name;
    size_t folder = folder_length(main_deck);
    diagnostics_add(
        loader->diagnostics, SEVERITY_ERROR, source, block->keyword,
        "cannot find the file '%.200s'; it is sought in '%.*s', beside the file that includes it, in the %zu "
        "folders of *INCLUDE_PATH and in the working directory",
        name, folder ? (int)folder : 2, folder ? main_deck : "./", loader->deck->store->folders.count);
    return false;
}

/* Adds prefix + name + "/" to the folders searched. */
static void add_folder(DeckLoader *loader, const char *prefix, size_t prefix_length, const char *name)
{
    TextStore *store = loader->deck->store;
    size_t room = prefix_length + strlen(name) + 2;
    char *folder = memory_alloc(room, 1);
    if (!folder || memory_reserve((void **)&store->folders.items, &store->folders.capacity, store->folders.count + 1,
                                  sizeof *store->folders.items)) {
        memory_free(folder);
        loader_report_memory(loader);
        return;
    }
    snprintf(folder, room, "%.*s%s", (int)prefix_length, prefix, name);
    size_t length = strlen(folder);
    if (length > 0 && folder[length - 1] != '/') folder[length] = '/';
    store->folders.items[store->folders.count++] = folder;
}

static void read_paths(DeckLoader *loader, const DeckBlock *block, bool relative)
{
    CardReader cards = {block, 0, loader->deck->parameters, loader->diagnostics};
    char name[BILLOW_LONGEST_PATH];
    Source source;
    const char *main_deck = loader->open[0].name;
    while (read_file_name(&cards, name, &source)) {
        if (name[0] == '\0') continue;
        for (char *c = name; *c; c++) {
            if (*c == '\\') *c = '/';
        }
        if (!relative) add_folder(loader, "", 0, name);
        /* A plain path may be meant from the main deck's folder as well as from the working directory. */
        if (name[0] != '/') add_folder(loader, main_deck, folder_length(main_deck), name);
    }
}

static void read_includes(DeckLoader *loader, const DeckBlock *block)
{
    CardReader cards = {block, 0, loader->deck->parameters, loader->diagnostics};
    char name[BILLOW_LONGEST_PATH], path[BILLOW_LONGEST_PATH];
    Source source;
    int found = 0;
    while (read_file_name(&cards, name, &source)) {
        if (name[0] == '\0') continue;
        found++;
        replace_parameter(loader, block, name);
        if (find_file(loader, block, name, source, path)) {
            loader_load_file(loader, path, source, loader->transform);
        }
    }
    if (found == 0) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "the name of the file is missing; it stands on the line after the keyword");
    }
}

/* The cards behind the file name of *INCLUDE_TRANSFORM. */
typedef struct TransformCards {
    int idnoff, ideoff, idpoff, idmoff, idsoff, idfoff, iddoff, idroff, ilctmf, incout1, tranid;
    double fctmas, fcttim, fctlen, fctchg;
    char prefix[11], suffix[11], fcttem[11];
} TransformCards;

#define OFFSET(member) offsetof(TransformCards, member)

static const FieldSpec offset_fields[] = {
    {.name = "IDNOFF", .type = 'I', .columns = 10, .offset = OFFSET(idnoff)},
    {.name = "IDEOFF", .type = 'I', .columns = 10, .offset = OFFSET(ideoff)},
    {.name = "IDPOFF", .type = 'I', .columns = 10, .offset = OFFSET(idpoff)},
    {.name = "IDMOFF", .type = 'I', .columns = 10, .offset = OFFSET(idmoff)},
    {.name = "IDSOFF", .type = 'I', .columns = 10, .offset = OFFSET(idsoff)},
    {.name = "IDFOFF", .type = 'I', .columns = 10, .offset = OFFSET(idfoff)},
    {.name = "IDDOFF", .type = 'I', .columns = 10, .offset = OFFSET(iddoff)},
};

static const FieldSpec rest_fields[] = {
    {.name = "IDROFF", .type = 'I', .columns = 10, .offset = OFFSET(idroff)},
    {.name = "ILCTMF", .type = 'I', .columns = 10, .offset = OFFSET(ilctmf), .use = FIELD_REFUSED},
    {.name = "PREFIX", .type = 'A', .columns = 10, .offset = OFFSET(prefix), .use = FIELD_LISTED},
    {.name = "SUFFIX", .type = 'A', .columns = 10, .offset = OFFSET(suffix), .use = FIELD_LISTED},
};

static const FieldSpec factor_fields[] = {
    {.name = "FCTMAS", .type = 'F', .columns = 10, .offset = OFFSET(fctmas), .fallback = 1, .zero_is_default = true},
    {.name = "FCTTIM", .type = 'F', .columns = 10, .offset = OFFSET(fcttim), .fallback = 1, .zero_is_default = true},
    {.name = "FCTLEN", .type = 'F', .columns = 10, .offset = OFFSET(fctlen), .fallback = 1, .zero_is_default = true},
    {.name = "FCTTEM", .type = 'A', .columns = 10, .offset = OFFSET(fcttem)},
    {.name = "INCOUT1", .type = 'I', .columns = 10, .offset = OFFSET(incout1), .use = FIELD_LISTED},
    {.name = "FCTCHG",
     .type = 'F',
     .columns = 10,
     .offset = OFFSET(fctchg),
     .fallback = 1,
     .zero_is_default = true,
     .use = FIELD_LISTED},
};

static const FieldSpec id_fields[] = {
    {.name = "TRANID", .type = 'I', .columns = 10, .offset = OFFSET(tranid)},
};

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* FtoC and the like: the new temperature is factor * old + offset. */
static bool read_temperature_flag(const char *flag, double *factor, double *offset)
{
    static const struct {
        const char *flag;
        double factor, offset;
    } table[] = {
        {"", 1, 0},
        {"1", 1, 0},
        {"1.0", 1, 0},
        {"FTOC", 5.0 / 9.0, -32 * 5.0 / 9.0},
        {"CTOF", 1.8, 32},
        {"FTOK", 5.0 / 9.0, 273.15 - 32 * 5.0 / 9.0},
        {"KTOF", 1.8, 32 - 273.15 * 1.8},
        {"KTOC", 1, -273.15},
        {"CTOK", 1, 273.15},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        if (strcasecmp(flag, table[i].flag) != 0) continue;
        *factor = table[i].factor;
        *offset = table[i].offset;
        return true;
    }
    return false;
}

/* Reads what follows the file's name; -1 after an error. */
static int read_transform(DeckLoader *loader, CardReader *cards, IncludeTransform *transform)
{
    const DeckBlock *block = cards->block;
    TransformCards c = {0};
    Source source = block->source, factor_source;
    int errors = loader->diagnostics->errors;
    card_read(cards, offset_fields, COUNT(offset_fields), &c, false, "card 2", NULL);
    card_read(cards, rest_fields, COUNT(rest_fields), &c, false, "card 3", NULL);
    card_read(cards, factor_fields, COUNT(factor_fields), &c, false, "card 4", &factor_source);
    card_read(cards, id_fields, COUNT(id_fields), &c, false, "card 5", &source);
    if (loader->diagnostics->errors > errors) return -1;

    *transform = include_transform_identity();
    transform->idnoff = c.idnoff;
    transform->ideoff = c.ideoff;
    transform->idpoff = c.idpoff;
    transform->idmoff = c.idmoff;
    transform->idsoff = c.idsoff;
    transform->idfoff = c.idfoff;
    transform->iddoff = c.iddoff;
    transform->idroff = c.idroff;
    transform->fctmas = c.fctmas;
    transform->fcttim = c.fcttim;
    transform->fctlen = c.fctlen;
    if (!(c.fctmas > 0) || !(c.fcttim > 0) || !(c.fctlen > 0)) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, factor_source, block->keyword,
                        "FCTMAS, FCTTIM and FCTLEN must be positive");
        return -1;
    }
    if (!read_temperature_flag(c.fcttem, &transform->fcttem, &transform->temperature_offset)) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, factor_source, block->keyword,
                        "FCTTEM '%s' must be one of FtoC, CtoF, FtoK, KtoF, KtoC, CtoK, or blank", c.fcttem);
        return -1;
    }
    if (c.tranid == 0) return 0;
    int id = (int)include_transform_scale(block->transform, SCALE_ID_DEFINE, c.tranid);
    const Transformation *transformation = loader_find_transformation(loader, id);
    if (!transformation) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, source, block->keyword,
                        "TRANID %d is not defined; *DEFINE_TRANSFORMATION must stand before *INCLUDE_TRANSFORM",
                        c.tranid);
        return -1;
    }
    memcpy(transform->matrix, transformation->matrix, sizeof transform->matrix);
    return 0;
}

static void read_transformed_includes(DeckLoader *loader, const DeckBlock *block)
{
    CardReader cards = {block, 0, loader->deck->parameters, loader->diagnostics};
    char name[BILLOW_LONGEST_PATH], path[BILLOW_LONGEST_PATH];
    Source source;
    int found = 0;
    while (read_file_name(&cards, name, &source)) {
        if (name[0] == '\0') continue;
        found++;
        replace_parameter(loader, block, name);
        IncludeTransform *transform = loader_keep(loader, 1, sizeof *transform);
        IncludeTransform own;
        if (!transform || read_transform(loader, &cards, &own)) return;
        *transform = include_transform_compose(loader->transform, &own);
        if (find_file(loader, block, name, source, path)) loader_load_file(loader, path, source, transform);
    }
    if (found == 0) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, block->source, block->keyword,
                        "the name of the file is missing; it stands on the line after the keyword");
    }
}

bool loader_include(DeckLoader *loader, const DeckBlock *block)
{
    if (strcmp(block->keyword, "*INCLUDE") == 0) {
        read_includes(loader, block);
    } else if (strcmp(block->keyword, "*INCLUDE_PATH") == 0) {
        read_paths(loader, block, false);
    } else if (strcmp(block->keyword, "*INCLUDE_PATH_RELATIVE") == 0) {
        read_paths(loader, block, true);
    } else if (strcmp(block->keyword, "*INCLUDE_TRANSFORM") == 0) {
        read_transformed_includes(loader, block);
    } else {
        return false;
    }
    return true;
}
