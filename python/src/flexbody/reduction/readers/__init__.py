"""Readers of finite element models."""
