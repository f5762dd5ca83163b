/* Runs an FMU's library on a platform that no Python runs on here (see test_binaries.py).
   usage: foreign LIBRARY GUID RESOURCES STEP COUNT VALUE_REFERENCE...
   Prints the named real variables after every step; what the FMU logs goes to standard error. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#ifdef _WIN32
#include <windows.h>
static void *load(const char *path) { return (void *)LoadLibraryA(path); }
static void *symbol(void *library, const char *name) { return (void *)GetProcAddress((HMODULE)library, name); }
#else
#include <dlfcn.h>
static void *load(const char *path) { return dlopen(path, RTLD_NOW); }
static void *symbol(void *library, const char *name) { return dlsym(library, name); }
#endif

typedef void *Component;
typedef int Status;
typedef struct {
    void (*logger)(void *, const char *, Status, const char *, const char *, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, Status);
    void *environment;
} Callbacks;

static void logger(void *environment, const char *name, Status status, const char *category, const char *message, ...) {
    va_list arguments;
    va_start(arguments, message);
    fprintf(stderr, "%s %d %s: ", name, status, category);
    vfprintf(stderr, message, arguments);
    fprintf(stderr, "\n");
    va_end(arguments);
}

static void *library;

static void *function(const char *name) {
    void *found = symbol(library, name);
    if (!found) {
        fprintf(stderr, "no %s\n", name);
        exit(2);
    }
    return found;
}

static void check(const char *call, Status status) {
    if (status) {
        fprintf(stderr, "%s answers %d\n", call, status);
        exit(3);
    }
}

int main(int count, char **arguments) {
    if (count < 7) return 1;
    library = load(arguments[1]);
    if (!library) {
        fprintf(stderr, "%s does not load\n", arguments[1]);
        return 2;
    }
    Component (*instantiate)(const char *, int, const char *, const char *, const Callbacks *, int, int) = function("fmi2Instantiate");
    Status (*setup)(Component, int, double, double, int, double) = function("fmi2SetupExperiment");
    Status (*enter)(Component) = function("fmi2EnterInitializationMode");
    Status (*leave)(Component) = function("fmi2ExitInitializationMode");
    Status (*step)(Component, double, double, int) = function("fmi2DoStep");
    Status (*get)(Component, const unsigned *, size_t, double *) = function("fmi2GetReal");
    Status (*terminate)(Component) = function("fmi2Terminate");
    void (*release)(Component) = function("fmi2FreeInstance");

    Callbacks callbacks = {logger, calloc, free, 0, 0};
    Component instance = instantiate("foreign", 1, arguments[2], arguments[3], &callbacks, 0, 1);
    if (!instance) return 3;
    check("fmi2SetupExperiment", setup(instance, 0, 0.0, 0.0, 0, 0.0));
    check("fmi2EnterInitializationMode", enter(instance));
    check("fmi2ExitInitializationMode", leave(instance));
    double length = atof(arguments[4]);
    for (int index = 0; index < atoi(arguments[5]); index++) {
        check("fmi2DoStep", step(instance, index * length, length, 1));
        for (int at = 6; at < count; at++) {
            unsigned reference = (unsigned)atoi(arguments[at]);
            double value;
            check("fmi2GetReal", get(instance, &reference, 1, &value));
            printf("%.17g ", value);
        }
        printf("\n");
    }
    check("fmi2Terminate", terminate(instance));
    release(instance);
    return 0;
}
