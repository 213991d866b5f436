"""Measurements that pages of docs/ quote, each made by one command."""
