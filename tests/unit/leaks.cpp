// What LeakSanitizer shall not hold against the tests.

// assimp 5.2.5 forgets the file it has open when an importer throws on a broken one.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp.so\n"; }
