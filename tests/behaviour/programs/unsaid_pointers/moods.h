typedef unsigned char level_t;
struct mood { int (*passive)(); void (*active)(); };
typedef struct { level_t (*read)(); int pin; } sensor_t;
extern struct mood moods[2];
extern sensor_t sensors[2];
extern void (*shared)();
void each(void (*what)());
void begin(void);
