/* Runs the built program in a folder of its own and shows tests what it did. */
#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* nftw */
#endif
#include "tests/program.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MOST_WORDS = 24 };

void program_open(Program *program)
{
    memset(program, 0, sizeof *program);
    snprintf(program->folder, sizeof program->folder, "program-XXXXXX");
    assert_non_null(mkdtemp(program->folder));
}

static int remove_entry(const char *path, const struct stat *status, int kind, struct FTW *place)
{
    (void)status, (void)kind, (void)place;
    return remove(path);
}

void program_close(Program *program)
{
    assert_int_equal(program->process, 0);
    assert_int_equal(nftw(program->folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS), 0);
}

static void path_of(const Program *program, const char *name, char *path, size_t size)
{
    assert_true(snprintf(path, size, "%s/%s", program->folder, name) < (int)size);
}

/* In the child: standard output and error into files beside the folder, then the program. */
static void become_program(const Program *program, char *const *words)
{
    char out[80], err[80];
    snprintf(out, sizeof out, "%s.out", program->folder);
    snprintf(err, sizeof err, "%s.err", program->folder);
    const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const int err_file = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (out_file < 0 || err_file < 0 || dup2(out_file, STDOUT_FILENO) < 0 || dup2(err_file, STDERR_FILENO) < 0 ||
        chdir(program->folder))
        _exit(120);
    execv(BILLOW_BINARY, words);
    _exit(121);
}

void program_start(Program *program, const char *line)
{
    char text[512];
    char *words[MOST_WORDS + 1] = {"billow"};
    int count = 1;
    assert_int_equal(program->process, 0);
    snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word && count < MOST_WORDS; word = strtok(NULL, " ")) words[count++] = word;
    program->process = fork();
    assert_true(program->process >= 0);
    if (program->process == 0) become_program(program, words);
}

static void take_output(const Program *program, const char *suffix, char *text)
{
    char path[80];
    snprintf(path, sizeof path, "%s.%s", program->folder, suffix);
    FILE *file = fopen(path, "r");
    text[file ? fread(text, 1, PROGRAM_TEXT - 1, file) : 0] = '\0';
    if (file) fclose(file);
    unlink(path);
}

int program_wait(Program *program)
{
    int status = 0;
    assert_true(program->process > 0);
    assert_int_equal(waitpid(program->process, &status, 0), program->process);
    program->process = 0;
    program->code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    take_output(program, "out", program->out);
    take_output(program, "err", program->err);
    return program->code;
}

int program_run(Program *program, const char *line)
{
    program_start(program, line);
    return program_wait(program);
}

bool program_wait_for(Program *program, const char *name)
{
    const struct timespec pause = {.tv_nsec = 5000000};
    for (int i = 0; i < 4000; i++) {
        if (program_exists(program, name)) return true;
        nanosleep(&pause, NULL);
    }
    return false;
}

void program_write(const Program *program, const char *name, const void *data, size_t size)
{
    char path[128];
    path_of(program, name, path, sizeof path);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

bool program_read(const Program *program, const char *name, char *text, size_t size)
{
    char path[128];
    path_of(program, name, path, sizeof path);
    FILE *file = fopen(path, "rb");
    text[file ? fread(text, 1, size - 1, file) : 0] = '\0';
    if (file) fclose(file);
    return file != NULL;
}

bool program_exists(const Program *program, const char *name)
{
    char path[128];
    path_of(program, name, path, sizeof path);
    return access(path, F_OK) == 0;
}

int program_count(const Program *program)
{
    DIR *stream = opendir(program->folder);
    assert_non_null(stream);
    int count = -2; /* . and .. */
    while (readdir(stream)) count++;
    closedir(stream);
    return count;
}

void program_make_bag(Scene *scene, int n)
{
    SceneText *deck = &scene->deck;
    SceneFabric fabric = scene_isotropic(2, true, 800.0, 4e8, 0.4);
    SceneGas gas = scene_air(101325.0, 296.15);
    fabric.damp = 0.05;
    gas.inflow_temperature = 400.0;
    gas.inflow_curve = 1;
    scene_add_sphere(&scene->mesh, 1, SCENE_QUADS, n, 0.3);
    scene_begin(deck, "sphere of fabric", 0.1, 0.9);
    scene_write_output(deck, 5e-4, 5e-4, 2.5e-3);
    scene_write_part(deck, 1, 1, 1, "sphere");
    scene_write_section(deck, 1, 9, 4e-4);
    scene_write_fabric(deck, 1, &fabric);
    scene_write_part_set(deck, 1, 1, (const int[]){1});
    scene_write_ramp(deck, 1, 0.01, 0.5);
    scene_write_simple_airbag(deck, 1, &gas);
    scene_end(deck, &scene->mesh);
}

void program_write_bag(const Program *program, const char *name, int n, const char *add)
{
    Scene scene = {0};
    program_make_bag(&scene, n);
    assert_true(scene_ok(&scene));
    char *end = strstr(scene.deck.text, "*END");
    assert_non_null(end);
    const size_t head = (size_t)(end - scene.deck.text), more = add ? strlen(add) : 0;
    char *text = malloc(head + more + 5);
    assert_non_null(text);
    memcpy(text, scene.deck.text, head);
    if (more) memcpy(text + head, add, more);
    memcpy(text + head + more, "*END\n", 5);
    program_write(program, name, text, head + more + 5);
    free(text);
    scene_free(&scene);
}

const char *program_last_line(const char *text)
{
    static char line[256];
    size_t end = strlen(text);
    while (end > 0 && text[end - 1] == '\n') end--;
    size_t start = end;
    while (start > 0 && text[start - 1] != '\n') start--;
    snprintf(line, sizeof line, "%.*s", (int)(end - start), text + start);
    return line;
}

const char *program_summary(const Program *program, const char *directory, const char *member)
{
    static char value[128];
    char name[96], text[4096], key[64];
    snprintf(name, sizeof name, "%s/summary.json", directory);
    if (!program_read(program, name, text, sizeof text)) fail_msg("%s is missing", name);
    snprintf(key, sizeof key, "\"%s\": ", member);
    const char *found = strstr(text, key);
    if (!found) fail_msg("%s has no member %s", name, member);
    found += strlen(key);
    snprintf(value, sizeof value, "%.*s", (int)strcspn(found, ",\n"), found);
    return value;
}
