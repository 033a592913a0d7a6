typedef unsigned char level_t;
struct mood { int (*passive)(); void (*active)(); };  // becomes struct mood { int32_t (*passive)(int32_t); void (*active)(int32_t, float); };
typedef struct { level_t (*read)(); int pin; } sensor_t;  // becomes typedef struct { level_t (*read)(level_t); int32_t pin; } sensor_t;
extern struct mood moods[2];
extern sensor_t sensors[2];
extern void (*shared)();  // becomes extern void (*shared)(const char *);
void each(void (*what)());  // becomes void each(void (*what)(int32_t, float));
