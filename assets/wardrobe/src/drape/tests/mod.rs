mod cloths;
mod physics;
