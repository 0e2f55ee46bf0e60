"""Language models in this process: GGUF weights, run by llama.cpp, with decoding constrained by the schema."""
