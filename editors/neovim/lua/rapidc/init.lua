-- ABB RAPID with rapidc in Neovim 0.7 and newer, without plugins:
--   require('rapidc').setup { cmd = { 'rapidc', 'lsp' }, settings = { warnings = {} } }

local M = { config = { cmd = { 'rapidc', 'lsp' }, settings = { warnings = {} } } }

local clients = {} -- by root

local function root_of(path)
  local folder = vim.fn.fnamemodify(path, ':p:h')
  local at = folder
  while true do
    for _, mark in ipairs({ 'rapidc.json', 'backinfo.txt', '.git' }) do
      if vim.fn.filereadable(at .. '/' .. mark) == 1 or vim.fn.isdirectory(at .. '/' .. mark) == 1 then return at end
    end
    local parent = vim.fn.fnamemodify(at, ':h')
    if parent == at then return folder end
    at = parent
  end
end

local function on_attach(client, buffer)
  vim.api.nvim_buf_set_option(buffer, 'omnifunc', 'v:lua.vim.lsp.omnifunc')
  local function map(key, action)
    vim.api.nvim_buf_set_keymap(buffer, 'n', key, '<cmd>lua ' .. action .. '<CR>', { noremap = true, silent = true })
  end
  map('K', 'vim.lsp.buf.hover()')
  map('gd', 'vim.lsp.buf.definition()')
  map('gr', 'vim.lsp.buf.references()')
  map('<leader>rn', 'vim.lsp.buf.rename()')
  map('<leader>ca', 'vim.lsp.buf.code_action()')
  if M.config.on_attach then M.config.on_attach(client, buffer) end
end

--- Connects a buffer with the server of its root. Returns the number of the client.
function M.attach(buffer)
  if buffer == 0 then buffer = vim.api.nvim_get_current_buf() end
  local root = root_of(vim.api.nvim_buf_get_name(buffer))
  local id = clients[root]
  if not id or not vim.lsp.get_client_by_id(id) then
    id = vim.lsp.start_client {
      name = 'rapidc',
      cmd = M.config.cmd,
      root_dir = root,
      workspace_folders = { { uri = vim.uri_from_fname(root), name = vim.fn.fnamemodify(root, ':t') } },
      init_options = M.config.settings,
      settings = { rapidc = M.config.settings },
      capabilities = M.config.capabilities or vim.lsp.protocol.make_client_capabilities(),
      on_attach = on_attach,
      get_language_id = function() return 'rapid' end,
      on_exit = function() clients[root] = nil end,
    }
    clients[root] = id
  end
  if id then vim.lsp.buf_attach_client(buffer, id) end
  return id
end

--- nvim-dap, when it is there: launch configurations of the virtual controller.
local function setup_dap()
  local found, dap = pcall(require, 'dap')
  if not found then return end
  dap.adapters.rapidc = { type = 'executable', command = M.config.cmd[1], args = { 'dap' } }
  dap.configurations.rapid = {
    { type = 'rapidc', request = 'launch', name = 'Run this module', program = '${file}' },
    { type = 'rapidc', request = 'launch', name = 'Run the folder', program = '${workspaceFolder}', stopOnEntry = true },
  }
end

function M.setup(config)
  M.config = vim.tbl_deep_extend('force', M.config, config or {})
  vim.cmd [[
    augroup rapidc
      autocmd!
      autocmd FileType rapid lua require('rapidc').attach(tonumber(vim.fn.expand('<abuf>')))
    augroup END
  ]]
  setup_dap()
end

return M
