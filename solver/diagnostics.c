/* Messages about the user's input and the run: collected, counted, ordered and printed. */
#include "solver/diagnostics.h"

#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include "solver/billow.h"
#include "solver/memory.h"

enum {
    STORED_ERRORS = 200,    /* more would bury the first */
    STORED_WARNINGS = 1000, /* likewise, for warnings and for notes */
    TEXT_LENGTH = 1000,     /* longest message */
};

void diagnostics_free(Diagnostics *diagnostics)
{
    for (size_t i = 0; i < diagnostics->count; i++) memory_free(diagnostics->messages[i].text);
    for (size_t i = 0; i < diagnostics->file_count; i++) memory_free(diagnostics->files[i]);
    memory_free(diagnostics->messages);
    memory_free(diagnostics->files);
    memset(diagnostics, 0, sizeof *diagnostics);
}

static char *copy_text(const char *text)
{
    size_t length = strlen(text);
    char *copy = memory_alloc(length + 1, 1);
    if (copy) memcpy(copy, text, length + 1);
    return copy;
}

int diagnostics_add_file(Diagnostics *diagnostics, const char *name)
{
    if (diagnostics->file_count >= INT32_MAX) return -1;
    if (memory_reserve((void **)&diagnostics->files, &diagnostics->file_capacity, diagnostics->file_count + 1,
                       sizeof *diagnostics->files)) {
        return -1;
    }
    char *copy = copy_text(name);
    if (!copy) return -1;
    diagnostics->files[diagnostics->file_count] = copy;
    return (int)diagnostics->file_count++;
}

/* Length of the well-formed UTF-8 sequence of a printing character at s, 0 if there is none. */
static size_t printing_length(const unsigned char *s)
{
    if (s[0] >= 0x20 && s[0] < 0x7f) return 1;
    if (s[0] < 0xc2 || s[0] > 0xf4) return 0;
    size_t length = s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : 4;
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) return 0;
    }
    if (s[0] == 0xc2 && s[1] < 0xa0) return 0; /* C1 control characters */
    return length;
}

/* Messages quote the deck: bytes that would upset a terminal become question marks. */
static void replace_unprintable(char *text)
{
    for (unsigned char *s = (unsigned char *)text; *s;) {
        size_t length = printing_length(s);
        if (length == 0) {
            *s = '?';
            length = 1;
        }
        s += length;
    }
}

static size_t count_stored(const Diagnostics *diagnostics, Severity severity)
{
    size_t stored = 0;
    for (size_t i = 0; i < diagnostics->count; i++) stored += diagnostics->messages[i].severity == severity;
    return stored;
}

/* Counts the message; true if it is to be stored. */
static bool count_message(Diagnostics *diagnostics, Severity severity)
{
    switch (severity) {
    case SEVERITY_ENVIRONMENT:
        diagnostics->environment++;
        return diagnostics->environment <= STORED_ERRORS;
    case SEVERITY_ERROR:
        diagnostics->errors++;
        if (diagnostics->errors > STORED_ERRORS) diagnostics->suppressed++;
        return diagnostics->errors <= STORED_ERRORS;
    case SEVERITY_WARNING:
        diagnostics->warnings++;
        return diagnostics->warnings <= STORED_WARNINGS;
    case SEVERITY_NOTE:
        break;
    }
    diagnostics->notes++;
    return diagnostics->notes <= STORED_WARNINGS;
}

void diagnostics_add(Diagnostics *diagnostics, Severity severity, Source source, const char *keyword,
                     const char *format, ...)
{
    if (!count_message(diagnostics, severity)) return;
    char text[TEXT_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    replace_unprintable(text);

    /* Without memory the message is lost but not its count, so that the exit code stays right. */
    if (memory_reserve((void **)&diagnostics->messages, &diagnostics->capacity, diagnostics->count + 1,
                       sizeof *diagnostics->messages)) {
        return;
    }
    Message *message = &diagnostics->messages[diagnostics->count];
    *message = (Message){.severity = severity, .source = source, .text = copy_text(text)};
    if (!message->text) return;
    snprintf(message->keyword, sizeof message->keyword, "%s", keyword ? keyword : "");
    replace_unprintable(message->keyword);
    diagnostics->count++;
}

void diagnostics_print_message(const Diagnostics *diagnostics, const Message *message, FILE *stream)
{
    static const char *const names[] = {"note", "warning", "error", "error"};
    Source source = message->source;
    if (source.file >= 0 && (size_t)source.file < diagnostics->file_count) {
        fprintf(stream, "%s:", diagnostics->files[source.file]);
        if (source.line > 0) fprintf(stream, "%d:", source.line);
        fputc(' ', stream);
    }
    fprintf(stream, "%s: ", names[message->severity]);
    if (message->keyword[0]) fprintf(stream, "%s: ", message->keyword);
    fprintf(stream, "%s\n", message->text);
}

/* True if a is printed after b: least severe last, then deck order, messages without a place last. */
static bool comes_after(const Message *a, const Message *b)
{
    if (a->severity != b->severity) return a->severity < b->severity;
    if (a->source.file != b->source.file) return (unsigned)a->source.file > (unsigned)b->source.file;
    return a->source.line > b->source.line;
}

/* Stable merge sort of order[0 .. count) with as much room in spare. */
static void sort_messages(const Message *messages, size_t *order, size_t *spare, size_t count)
{
    if (count < 2) return;
    size_t half = count / 2;
    sort_messages(messages, order, spare, half);
    sort_messages(messages, order + half, spare, count - half);
    memcpy(spare, order, half * sizeof *order);
    size_t left = 0, right = half, out = 0;
    while (left < half) {
        bool take_right = right < count && comes_after(&messages[spare[left]], &messages[order[right]]);
        order[out++] = take_right ? order[right++] : spare[left++];
    }
}

static void print_rest(const char *what, int total, size_t stored, FILE *stream)
{
    if (total > 0 && (size_t)total > stored) fprintf(stream, "%zu more %s not shown\n", (size_t)total - stored, what);
}

void diagnostics_print(const Diagnostics *diagnostics, Severity least, FILE *stream)
{
    size_t count = diagnostics->count;
    size_t *order = memory_alloc(2 * count + 1, sizeof *order);
    if (order) {
        for (size_t i = 0; i < count; i++) order[i] = i;
        sort_messages(diagnostics->messages, order, order + count, count);
    }
    for (size_t i = 0; i < count; i++) {
        const Message *message = &diagnostics->messages[order ? order[i] : i];
        if (message->severity >= least) diagnostics_print_message(diagnostics, message, stream);
    }
    memory_free(order);
    print_rest("errors", diagnostics->errors, count_stored(diagnostics, SEVERITY_ERROR), stream);
    if (least <= SEVERITY_WARNING) {
        print_rest("warnings", diagnostics->warnings, count_stored(diagnostics, SEVERITY_WARNING), stream);
    }
    if (least <= SEVERITY_NOTE) {
        print_rest("notes", diagnostics->notes, count_stored(diagnostics, SEVERITY_NOTE), stream);
    }
}

int diagnostics_exit_code(const Diagnostics *diagnostics)
{
    if (diagnostics->environment > 0) return BILLOW_EXIT_ENVIRONMENT;
    return diagnostics->errors > 0 ? BILLOW_EXIT_INPUT : BILLOW_EXIT_NORMAL;
}
