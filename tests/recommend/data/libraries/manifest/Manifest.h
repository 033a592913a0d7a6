class Manifest {};
