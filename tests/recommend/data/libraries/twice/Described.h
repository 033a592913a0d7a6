class Twice {};
