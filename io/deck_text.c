/* A whole deck loaded: its files, its blocks, and the memory that holds them. */
#include <stdio.h>
#include <string.h>

#include "io/deck_file.h"
#include "io/deck_loader.h"
#include "solver/memory.h"

enum { CHUNK_BYTES = 1 << 18 };

void loader_report_memory(DeckLoader *loader)
{
    diagnostics_add(loader->diagnostics, SEVERITY_ENVIRONMENT, (Source){loader->file, 0}, NULL,
                    "no memory left to load the deck");
}

/* Hands the block over to the store; it is released if that fails. */
static void *own_memory(DeckLoader *loader, void *memory)
{
    TextStore *store = loader->deck->store;
    if (!memory || memory_reserve((void **)&store->owned.items, &store->owned.capacity, store->owned.count + 1,
                                  sizeof *store->owned.items)) {
        memory_free(memory);
        loader_report_memory(loader);
        return NULL;
    }
    store->owned.items[store->owned.count++] = memory;
    return memory;
}

void *loader_keep(DeckLoader *loader, size_t count, size_t size)
{
    return own_memory(loader, memory_alloc(count, size));
}

char *loader_keep_text(DeckLoader *loader, size_t length)
{
    TextStore *store = loader->deck->store;
    if (length > store->chunk_left) {
        size_t bytes = length > CHUNK_BYTES ? length : CHUNK_BYTES;
        store->chunk = loader_keep(loader, bytes, 1);
        store->chunk_left = store->chunk ? bytes : 0;
        if (!store->chunk) return NULL;
    }
    char *text = store->chunk;
    store->chunk += length;
    store->chunk_left -= length;
    return text;
}

/* Refuses what would never end. */
static bool may_include(DeckLoader *loader, const DeckFile *file, const char *path, Source from)
{
    for (int i = 0; i < loader->depth; i++) {
        const OpenFile *open = &loader->open[i];
        if (open->inode == 0 || open->inode != file->inode || open->device != file->device) continue;
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, from, "*INCLUDE",
                        "'%s' includes itself%s; break the circle", path,
                        i + 1 < loader->depth ? " through other files" : "");
        return false;
    }
    if (loader->depth >= BILLOW_INCLUDE_DEPTH || loader->file_count >= BILLOW_INCLUDE_FILES) {
        diagnostics_add(loader->diagnostics, SEVERITY_ERROR, from, "*INCLUDE",
                        "'%s' is not read: files may be nested %d deep, and there may be %d of them", path,
                        (int)BILLOW_INCLUDE_DEPTH, (int)BILLOW_INCLUDE_FILES);
        return false;
    }
    return true;
}

/* Splits the text as the file path one level below the present one. */
static void enter_file(DeckLoader *loader, const char *path, DeckFile *file, const IncludeTransform *transform)
{
    DeckLoader outer = *loader;
    bool is_main = loader->file_count == 0;
    int index = diagnostics_add_file(loader->diagnostics, path);
    char *text = own_memory(loader, file->text);
    loader->scope = is_main ? 0 : parameters_add_scope(loader->deck->parameters, outer.scope);
    if (index < 0 || loader->scope < 0) loader_report_memory(loader);
    if (index >= 0 && loader->scope >= 0 && text) {
        loader->file = index;
        loader->transform = transform;
        loader->open[loader->depth] = (OpenFile){path, file->device, file->inode};
        loader->depth++;
        loader->file_count++;
        loader_split_text(loader, text, file->length);
        loader->depth--;
    }
    loader->file = outer.file;
    loader->scope = outer.scope;
    loader->wide = outer.wide;
    loader->i10 = outer.i10;
    loader->transform = outer.transform;
}

static void report_unreadable(DeckLoader *loader, const char *path, Source from, const char *problem, Severity severity)
{
    if (from.file < 0) {
        Source main_deck = {diagnostics_add_file(loader->diagnostics, path), 0};
        diagnostics_add(loader->diagnostics, severity, main_deck, NULL, "%s", problem);
    } else {
        diagnostics_add(loader->diagnostics, severity, from, "*INCLUDE", "'%s': %s", path, problem);
    }
}

void loader_load_file(DeckLoader *loader, const char *path, Source from, const IncludeTransform *transform)
{
    DeckFile file;
    bool no_memory;
    const char *problem = deck_file_read(path, &file, &no_memory);
    if (problem) {
        report_unreadable(loader, path, from, problem, no_memory ? SEVERITY_ENVIRONMENT : SEVERITY_ERROR);
        return;
    }
    if (!may_include(loader, &file, path, from)) {
        memory_free(file.text);
        return;
    }
    enter_file(loader, path, &file, transform);
}

/* A deck from memory: as if a file of that name had been read. */
static void load_text(DeckLoader *loader, const char *path, const char *text, size_t length)
{
    DeckFile file = {.text = memory_alloc(length + 1, 1), .length = length};
    if (!file.text) {
        loader_report_memory(loader);
        return;
    }
    if (length > 0) memcpy(file.text, text, length);
    enter_file(loader, path, &file, NULL);
}

int deck_text_load(const char *path, const char *text, size_t length, DeckText *deck, Diagnostics *diagnostics)
{
    int before = diagnostics->errors + diagnostics->environment;
    *deck = (DeckText){.store = memory_alloc(1, sizeof(TextStore)), .parameters = parameters_create()};
    DeckLoader loader = {.deck = deck, .diagnostics = diagnostics, .file = -1};
    if (!deck->store || !deck->parameters) {
        loader_report_memory(&loader);
        deck_text_free(deck);
        return -1;
    }
    if (text) {
        load_text(&loader, path, text, length);
    } else {
        loader_load_file(&loader, path, BILLOW_NO_SOURCE, NULL);
    }
    return diagnostics->errors + diagnostics->environment > before ? -1 : 0;
}

void deck_text_free(DeckText *deck)
{
    if (deck->store) {
        TextStore *store = deck->store;
        for (size_t i = 0; i < store->owned.count; i++) memory_free(store->owned.items[i]);
        for (size_t i = 0; i < store->folders.count; i++) memory_free(store->folders.items[i]);
        memory_free(store->owned.items);
        memory_free(store->folders.items);
        memory_free(store->transformations.items);
        memory_free(store->nodes.items);
        memory_free(store);
    }
    parameters_free(deck->parameters);
    memory_free(deck->blocks.items);
    *deck = (DeckText){0};
}
